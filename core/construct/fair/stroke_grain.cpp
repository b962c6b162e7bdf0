// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/stroke_grain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kShortestStretchPx = 8.0;  // as the blocks of the fit: below, its own noise tells
constexpr double kLeastGrainPx = 0.05;      // a clean pen has as much: the fit's own noise tells it
constexpr int kFewestDifferences = 8;       // the middle of fewer is a matter of luck
constexpr double kMedianOfSquare = 0.4549;  // of the square of a standard normal variable
constexpr double kFourthDifference[] = {1.0, -4.0, 6.0, -4.0, 1.0};
constexpr double kSecondDifferenceVariance = 6.0, kFourthDifferenceVariance = 70.0;  // of one of a mean
constexpr double kLeastPlacedShare = 0.5;                                            // of the points of a stretch
constexpr double kMostBorderWidths = 0.5;  // of the pencil: what its border scatters by; more is drawn

/// Of a single stroke: where several were merged, neighbouring points have the widths of different ones.
bool hasWidth(const PiecePoint& p) { return p.refined && !p.spreadPx && p.widthPx && std::isfinite(*p.widthPx); }

/// Means over a stretch of a line.
struct GrainStretch {
  Vec2 at = Vec2::Zero();
  double halfWidthPx = 0.0;
};

/// Absent where too few points were placed.
std::vector<std::optional<GrainStretch>> stretchesOf(const std::vector<PiecePoint>& points, double stretchPx,
                                                     bool (*isPlaced)(const PiecePoint&)) {
  std::vector<std::optional<GrainStretch>> means;
  GrainStretch sum;
  double placed = 0.0, length = 0.0;
  int all = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PiecePoint& p = points[i];
    length += (p.at - points[i - 1].at).norm();
    ++all;
    if (isPlaced(p)) {
      sum.at += p.at;
      sum.halfWidthPx += 0.5 * static_cast<double>(p.widthPx.value_or(0.0f));
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

double varianceFrom(std::vector<double>& squares, double differenceVariance) {
  return upperMedian(squares) / (kMedianOfSquare * differenceVariance);
}

/// Squares of the second differences of means over neighbouring stretches.
struct GrainSquares {
  std::vector<double> ofWidth, ofCentre;
};

GrainSquares squaresOfStroke(const ConstructContour& contour, double stretchPx) {
  GrainSquares squares;
  for (const ConstructPiece& piece : contour.pieces) {
    const std::vector<std::optional<GrainStretch>> means = stretchesOf(piece.points, stretchPx, hasWidth);
    for (std::size_t i = 1; i + 1 < means.size(); ++i) {
      const auto &before = means[i - 1], &here = means[i], &after = means[i + 1];
      if (!before || !here || !after) continue;
      const Vec2 chord = after->at - before->at;
      if (!(chord.norm() > 0.0)) continue;
      const double across = cross(chord.normalized(), before->at - 2.0 * here->at + after->at);
      squares.ofCentre.push_back(across * across);
      squares.ofWidth.push_back(std::pow(before->halfWidthPx - 2.0 * here->halfWidthPx + after->halfWidthPx, 2));
    }
  }
  return squares;
}

/// Squares of the fourth differences, which a bend of the border does not reach: no width tells it from the grain.
std::vector<double> squaresOfBorder(const ConstructContour& contour, double stretchPx) {
  std::vector<double> squares;
  for (const ConstructPiece& piece : contour.pieces) {
    const std::vector<std::optional<GrainStretch>> means =
        stretchesOf(piece.points, stretchPx, [](const PiecePoint& p) { return p.refined; });
    for (std::size_t i = 0; i + std::size(kFourthDifference) <= means.size(); ++i) {
      Vec2 difference = Vec2::Zero();
      bool isKnown = true;
      for (std::size_t k = 0; k < std::size(kFourthDifference); ++k) {
        isKnown = isKnown && means[i + k].has_value();
        if (isKnown) difference += kFourthDifference[k] * means[i + k]->at;
      }
      if (!isKnown) continue;
      const Vec2 chord = means[i + std::size(kFourthDifference) - 1]->at - means[i]->at;
      if (chord.norm() > 0.0) squares.push_back(std::pow(cross(chord.normalized(), difference), 2));
    }
  }
  return squares;
}

StrokeGrain borderGrain(const ConstructContour& contour, double pencilPx) {
  const double stretchPx = std::max(kShortestStretchPx, pencilPx);
  std::vector<double> squares = squaresOfBorder(contour, stretchPx);
  if (std::ssize(squares) < kFewestDifferences) return {};
  const double variance =
      std::min(varianceFrom(squares, kFourthDifferenceVariance), std::pow(kMostBorderWidths * pencilPx, 2));
  return {stretchPx * variance, std::sqrt(variance)};
}

}  // namespace

StrokeGrain strokeGrain(const ConstructContour& contour) {
  if (contour.pencilPx) return borderGrain(contour, *contour.pencilPx);
  if (!contour.isStroke) return {};
  std::vector<float> widths;
  for (const ConstructPiece& piece : contour.pieces) {
    for (const PiecePoint& p : piece.points)
      if (hasWidth(p)) widths.push_back(*p.widthPx);
  }
  if (widths.empty()) return {};
  const double stretchPx = std::max(kShortestStretchPx, static_cast<double>(upperMedian(widths)));
  GrainSquares squares = squaresOfStroke(contour, stretchPx);
  if (std::ssize(squares.ofWidth) < kFewestDifferences) return {};
  // Where the pen swells, both borders move and the centre does not.
  const double variance = std::min(varianceFrom(squares.ofWidth, kSecondDifferenceVariance),
                                   varianceFrom(squares.ofCentre, kSecondDifferenceVariance));
  if (variance < kLeastGrainPx * kLeastGrainPx) return {};
  return {stretchPx * variance, std::sqrt(variance)};
}

}  // namespace batten
