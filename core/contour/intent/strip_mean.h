// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/intent/side_edges.h"
#include "core/contour/intent/stroke_pieces.h"

namespace batten {

/// A piece on the common arc length of its group: the sample k lies at direction * k + offset.
struct PlacedPiece {
  int piece = 0;
  double direction = 1.0;  ///< 1: it runs along, -1: against.
  double offset = 0.0;     ///< [stroke widths]
};

/// The mean of pieces that are taken for one curve.
struct PieceMean {
  Strip strip;                      ///< Its members are `placed`, ascending.
  std::vector<PlacedPiece> placed;  ///< Those that the mean is of.
  double from = 0.0;                ///< Common arc length of the first sample.
};

/// Makes means of pieces. Keeps references.
class PieceMeans {
 public:
  /// @param pairs all pairs of pieces side by side, whatever lies between them. @param areOne whether such a pair looks
  /// overdrawn.
  PieceMeans(const StrokePieceSet& set, const std::vector<StripPair>& pairs, const std::vector<bool>& areOne);

  /// The means of a group of pieces, the longest first: pieces that run along each other or go on in each other share
  /// one arc length, found along the cheapest relations, so that a curve that winds or crosses itself keeps its way
  /// round; what has no such relation has a mean of its own. A stroke counts less towards its ends.
  std::vector<PieceMean> of(const std::vector<int>& group) const;

 private:
  const StrokePieceSet& set_;
  const std::vector<StripPair>& pairs_;
  const std::vector<bool>& areOne_;
  std::vector<std::vector<int>> pairsOf_;  // by piece
};

}  // namespace batten
