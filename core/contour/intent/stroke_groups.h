// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/intent/intent_weights.h"
#include "core/contour/intent/strip_mean.h"
#include "core/contour/intent/stroke_pieces.h"

namespace batten {

/// Pairs of pieces of which one begins or ends freely beside the other, which goes on there, no farther than 8 widths
/// from it and over at least 5: what overdrawn lines show and clean parallels do not.
int overdrawnPlaces(const StrokePieceSet& set, const std::vector<StripPair>& pairs);

/// What a pair of strips looked like in a round: for learning weights.
struct SeenPair {
  int round = 0;       ///< From 0.
  bool isSide = true;  ///< Side by side; else end to end.
  std::vector<int> piecesA, piecesB;
  std::vector<double> features;  ///< sideFeatures() or endFeatures().
};

/// Weights other than the learned ones, and what was seen with them; where null, nothing is told.
struct GroupingProbe {
  const IntentWeights& weights = learnedWeights();
  std::vector<SeenPair>* pairs = nullptr;
  StrokePieceSet* pieces = nullptr;  ///< Set by intendedLines().
};

/// Groups pieces by the intended curves. What lies side by side or meets end to end gets log-odds
/// (intent_weights.h), the groups are those of contractGreedily(); three rounds, of which the first two join only what
/// is certain, because the ends, directions and widths of a bundle are known only once its strokes are one.
/// @param scale [stroke widths] > 0, the distance for merging that suits the page as a whole.
/// @return pieces by group, in the order of their first pieces. Not complete when cancelled.
std::vector<std::vector<int>> groupPieces(const StrokePieceSet& set, const PieceMeans& means,
                                          const std::vector<StripPair>& pairs, double scale, const RunContext& context,
                                          const GroupingProbe& probe = {});

/// [stroke widths] From here on two pieces do not lie side by side.
constexpr double kSideReach = 16.0;

/// Whether pieces side by side look like strokes of one line.
std::vector<bool> lookOverdrawn(const StrokePieceSet& set, const std::vector<StripPair>& pairs, double scale);

}  // namespace batten
