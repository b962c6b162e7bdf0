// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/cancel_check.h"
#include "core/construct/fair/fair_fit.h"
#include "core/construct/pieces.h"

namespace batten {

// Pieces and curves are in px here.

/// Points first..last of a piece. In closed pieces `last` may pass the number of points: indices count modulo.
struct PointRange {
  int first = 0, last = 0;
};

/// Stretches of a piece that turn more sharply than the fair fit can follow: unmarked corners, tips and
/// hairpins, with a little of the line on either side. In order, at most once round a closed piece.
std::vector<PointRange> sharpFeatures(const ConstructPiece&, bool isStroke, const FairFitOptions&);

/// Sorts ranges and unites those that leave less than `leastBetweenPx` of line between them, or between them and an
/// open end.
std::vector<PointRange> united(std::vector<PointRange>, const ConstructPiece&, double leastBetweenPx);

/// The stretches between sharp features, in order (closed: beginning after the first one); without any the whole piece.
std::vector<PointRange> between(const std::vector<PointRange>& features, const ConstructPiece&);

/// How far a point lies from a curve.
struct PointOffset {
  double distancePx = 0.0;  ///< Only what merged strokes or grain do not explain.
  double offPx = 0.0;       ///< All of it …
  double parameter = 0.0;   ///< … and where on the curve.
};
/// How far the points of a piece lie from a curve that should follow them in order.
struct PointDeviation {
  std::vector<PointOffset> points;  ///< In the order of the piece.
  double lengthRatio = 1.0;         ///< Of the curve to the points.
  int far = 0;                      ///< Points more than 1.5 px off in a row of neighbours that are.
  int veryFar = 0;                  ///< The same for 4 px.
  /// Everywhere near enough, and no longer than the points allow.
  bool good() const;
};
PointDeviation pointDeviation(const NurbsCurve&, const ConstructPiece&, CancelCheck check = {});

/// Where a curve has left the points: the ranges to treat as sharp features so that the rest can be fitted. Long ones
/// shrink to their sharpest place unless `whole`.
std::vector<PointRange> outlierRanges(const PointDeviation&, const ConstructPiece&, bool whole);

}  // namespace batten
