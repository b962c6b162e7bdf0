// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/stroke_grain.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kShortestStretchPx = 8.0;  // as the blocks of the fit: below, its own noise tells
constexpr int kFewestDifferences = 8;       // the middle of fewer is a matter of luck
constexpr double kMedianOfSquare = 0.4549;  // of the square of a standard normal variable
constexpr double kSecondDifference = 6.0;   // variances of a mean in that of a second difference
constexpr double kLeastPlacedShare = 0.5;   // of the points of a stretch

/// Of a single stroke: where several were merged, neighbouring points have the widths of different ones.
bool hasWidth(const PiecePoint& p) { return p.refined && !p.spreadPx && p.widthPx && std::isfinite(*p.widthPx); }

/// Means over a stretch of a line.
struct GrainStretch {
  Vec2 at = Vec2::Zero();
  double halfWidthPx = 0.0;
};

/// Absent where too few points were placed.
std::vector<std::optional<GrainStretch>> stretchesOf(const std::vector<PiecePoint>& points, double stretchPx) {
  std::vector<std::optional<GrainStretch>> means;
  GrainStretch sum;
  double placed = 0.0, length = 0.0;
  int all = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PiecePoint& p = points[i];
    length += (p.at - points[i - 1].at).norm();
    ++all;
    if (hasWidth(p)) {
      sum.at += p.at;
      sum.halfWidthPx += 0.5 * static_cast<double>(*p.widthPx);
      placed += 1.0;
    }
    if (length < stretchPx) continue;
    const bool isKnown = placed > 0.0 && placed >= kLeastPlacedShare * all;
    means.push_back(isKnown ? std::optional(GrainStretch{sum.at / placed, sum.halfWidthPx / placed}) : std::nullopt);
    sum = {};
    placed = length = 0.0;
    all = 0;
  }
  return means;
}

double varianceFrom(std::vector<double>& squares) {
  return upperMedian(squares) / (kMedianOfSquare * kSecondDifference);
}

}  // namespace

StrokeGrain strokeGrain(const ConstructContour& contour) {
  if (!contour.isStroke) return {};
  std::vector<float> widths;
  for (const ConstructPiece& piece : contour.pieces) {
    for (const PiecePoint& p : piece.points)
      if (hasWidth(p)) widths.push_back(*p.widthPx);
  }
  if (widths.empty()) return {};
  const double stretchPx = std::max(kShortestStretchPx, static_cast<double>(upperMedian(widths)));
  std::vector<double> ofWidth, ofCentre;
  for (const ConstructPiece& piece : contour.pieces) {
    const std::vector<std::optional<GrainStretch>> means = stretchesOf(piece.points, stretchPx);
    for (std::size_t i = 1; i + 1 < means.size(); ++i) {
      const auto &before = means[i - 1], &here = means[i], &after = means[i + 1];
      if (!before || !here || !after) continue;
      const Vec2 chord = after->at - before->at;
      if (!(chord.norm() > 0.0)) continue;
      const double across = cross(chord.normalized(), before->at - 2.0 * here->at + after->at);
      ofCentre.push_back(across * across);
      ofWidth.push_back(std::pow(before->halfWidthPx - 2.0 * here->halfWidthPx + after->halfWidthPx, 2));
    }
  }
  if (std::ssize(ofWidth) < kFewestDifferences) return {};
  // Where the pen swells, both borders move and the centre does not.
  const double variance = std::min(varianceFrom(ofWidth), varianceFrom(ofCentre));
  return {stretchPx * variance, std::sqrt(variance)};
}

}  // namespace batten
