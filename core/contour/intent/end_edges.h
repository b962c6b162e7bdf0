// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/intent/side_edges.h"
#include "core/contour/intent/strips.h"
#include "core/contour/intent/stroke_pieces.h"

namespace batten {

/// Two ends of different strips that lie near each other; ends are numbered 2 * strip + side.
struct EndPair {
  int a = 0, b = 0;                          ///< a < b.
  double gap = 0.0;                          ///< [stroke widths]
  double turnDeg = 0.0;                      ///< By which a curve would turn from one into the other; 0: straight on.
  double offset = 0.0;                       ///< The largest distance of an end from the line through the other.
  int links = 0, corners = 0;                ///< Of the trace between them; how many of these are corners.
  double cost = 0.0;                         ///< The less, the better one goes on in the other. [deg]
  double bestOther = 0.0, worseOther = 0.0;  ///< The least cost of other partners: of the end with less, with more.
  int arms = 0;                              ///< Other ends that lie as near.
};

/// What the ends are judged by beside the strips.
struct EndView {
  PairView view;
  const StrokePieceSet& pieces;
  const std::vector<StripPair>& sides;
};

constexpr int kEndFeatures = 33, kEndFeaturesLater = 44;  ///< Of endFeatures(): of pieces, of bundles.

/// All pairs of ends within 8 stroke widths, of bundles within 10.
std::vector<EndPair> findEndPairs(const EndView& view, const RunContext& context);
/// The numbers that the log-odds are a weighted sum of (intent_weights.h).
std::vector<double> endFeatures(const EndPair& pair, const EndView& view, bool isBesideToo);

/// [stroke widths] inside of the tip: the chord that gives the direction of an end. The last width turns to a corner of
/// the pen's end.
inline constexpr double kDirectionFrom = 6.0, kDirectionTo = 1.0;
/// Where a strip ends and the unit direction in which it does, out of it, from the chord between two places inside.
Vec2 directionOut(const Strip& strip, int side, double fromInside, double toInside);
/// The place of a strip at its start (side 0) or its end (1).
const Vec2& tipOf(const Strip& strip, int side);

}  // namespace batten
