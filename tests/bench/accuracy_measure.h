// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/pipeline/run/pipeline.h"
#include "tests/support/svg_paths.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {

/// A curve as points at even steps of about half a pixel. Image frame; kappa as TruthPiece::kappa.
struct SampledCurve {
  std::vector<Vec2> points;
  std::vector<double> kappa;  ///< [1/px]
  bool closed = false;        ///< Smooth closed: the last point is followed by the first.
};

/// What any tracer found on a page.
struct TraceResult {
  std::vector<SampledCurve> curves;
  std::vector<Vec2> corners;
  int controlPoints = 0;
  double milliseconds = 0.0;
  std::string failure;
};

/// How a result compares with the truth. Lengths in px of the scan. "Smooth parts" are at least 10 px from corners.
struct Accuracy {
  bool found = false;           ///< At least 95 % of the outline has a curve within 2 px.
  double coverage = 0.0;        ///< 0..1 of the outline.
  double outlierPx = 0.0;       ///< [px] length of curves that lie more than 6 px off the truth.
  double rmsPx = 0.0;           ///< Of the curves from the truth on smooth parts.
  double maxPx = 0.0;           ///< There.
  double curvatureError = 0.0;  ///< rms of (kappa - truth) times the diagonal of the shape, on smooth parts.
  int falseExtrema =
      0;  ///< Curvature extrema (prominence kExtremumProminence / diagonal) with no true one of their kind near.
  int missedExtrema = 0;  ///< True ones with none of their kind near.
  int trueExtrema = 0;
  double monotonePx = 0.0;                        ///< [px] of the stretches between extrema, smooth parts only,
  double flatPx = 0.0;                            ///< and how much of them lies flat (a plateau of the curvature).
  double trueMonotonePx = 0.0, trueFlatPx = 0.0;  ///< The same of the truth.
  int cornersFound = 0;                           ///< True corners with one found within 4 px.
  int cornersTrue = 0;
  int cornersFalse = 0;  ///< Found ones 4 px and more from every true one.
  struct CornerError {
    std::size_t corner = 0;     ///< Of the shape.
    double openingDeg = 0.0;    ///< Between its sides; 180 would be none.
    double errorPx = 0.0;       ///< Infinite: not found.
    Vec2 offPx = Vec2::Zero();  ///< Where it was found, from where it is.
  };
  std::vector<CornerError> corners;  ///< All true ones.
};

/// `borderPx`: the curves are compared with the lines this far on either side of the truth (a tracer that gives both
/// borders of a stroke instead of its middle); curvature and extrema are not compared then.
Accuracy compareWithTruth(const TruthShape& shape, const TraceResult& result, double borderPx = 0.0);

/// Runs the program on a page that shows `shape`, every corner marked by a click `clickOffsetPx` beside it; none is
/// marked where the recipe takes certain corners.
TraceResult traceShape(const TruthShape& shape, const Scan& scan, Recipe recipe, double clickOffsetPx);

/// Samples paths of cubics; points where the direction jumps by 20 degrees or more are corners.
TraceResult sampledPaths(const std::vector<SvgPath>& paths);

}  // namespace batten::test
