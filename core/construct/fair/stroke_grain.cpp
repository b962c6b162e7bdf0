// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/stroke_grain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kShortestStretchPx = 8.0;  // as the blocks of the fit: below, its own noise tells
constexpr int kFewestDifferences = 4;       // fewer are a matter of luck
constexpr double kMedianOfSquare = 0.4549;  // of the square of a standard normal variable
constexpr double kSecondDifference = 6.0;   // variances of a mean in that of a second difference
constexpr double kLeastPlacedShare = 0.5;   // of a stretch: points that were placed

/// Means of the half-width over stretches of a length, NaN where too few points of one were placed.
std::vector<double> halfWidths(const std::vector<PiecePoint>& points, double stretchPx) {
  std::vector<double> means;
  double sum = 0.0, placed = 0.0, length = 0.0;
  int all = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PiecePoint& p = points[i];
    length += (p.at - points[i - 1].at).norm();
    ++all;
    if (p.refined && p.widthPx && std::isfinite(*p.widthPx)) {
      sum += 0.5 * static_cast<double>(*p.widthPx);
      placed += 1.0;
    }
    if (length < stretchPx) continue;
    means.push_back(placed >= kLeastPlacedShare * all && placed > 0.0 ? sum / placed : std::nan(""));
    sum = placed = length = 0.0;
    all = 0;
  }
  return means;
}

}  // namespace

StrokeGrain strokeGrain(const ConstructContour& contour) {
  if (!contour.isStroke) return {};
  std::vector<float> widths;
  for (const ConstructPiece& piece : contour.pieces) {
    for (const PiecePoint& p : piece.points)
      if (p.refined && p.widthPx && std::isfinite(*p.widthPx)) widths.push_back(*p.widthPx);
  }
  if (widths.empty()) return {};
  const double stretchPx = std::max(kShortestStretchPx, static_cast<double>(upperMedian(widths)));
  std::vector<double> squares;
  for (const ConstructPiece& piece : contour.pieces) {
    const std::vector<double> means = halfWidths(piece.points, stretchPx);
    for (std::size_t i = 1; i + 1 < means.size(); ++i) {
      const double d = means[i - 1] - 2.0 * means[i] + means[i + 1];
      if (std::isfinite(d)) squares.push_back(d * d / kSecondDifference);
    }
  }
  if (std::ssize(squares) < kFewestDifferences) return {};
  const double variance = upperMedian(squares) / kMedianOfSquare;
  return {stretchPx * variance, std::sqrt(variance)};
}

}  // namespace batten
