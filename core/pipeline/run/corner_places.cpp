// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_places.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/angle.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/construct/fair/sharp_features.h"
#include "core/contour/corner/corner_certainty.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/contour/corner/short_sides.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kSmallLoopPx = 70.0;                   // round: radius 11 px
constexpr double kCertainAngleRad = 28.0 * kRadPerDeg;  // below the least turn of a certain corner
constexpr double kCertainScalePx = 14.0;                // along the line, at which certain corners are looked for
constexpr double kOneTurnPlacePx = 6.0;                 // places as near are of one turn

// [grey] The darkest or lightest pixel of a square about a place, as far as it lies on the page.
struct GreyRange {
  double darkest = 255.0, lightest = 0.0;
};
GreyRange greyAround(const GreyImage& page, const Vec2& place, double reachPx) {
  GreyRange range;
  const auto from = [&](double v) { return std::max(0, static_cast<int>(std::floor(v - reachPx))); };
  const auto to = [&](double v, int size) { return std::min(size - 1, static_cast<int>(std::floor(v + reachPx))); };
  for (int y = from(place.y()); y <= to(place.y(), page.height); ++y) {
    for (int x = from(place.x()); x <= to(place.x(), page.width); ++x) {
      range.darkest = std::min(range.darkest, page.level(x, y));
      range.lightest = std::max(range.lightest, page.level(x, y));
    }
  }
  return range;
}

// Sides that never met lead to a vertex on blank paper. The border of a shape may have lost its tip to the mask.
bool liesOnInk(const CornerSuggestion& corner, const Contour& contour, const GreyImage& page) {
  constexpr int kBesidePoints = 20;    // of the contour, to either side
  constexpr double kPaperReach = 3.0;  // widths of the stroke
  constexpr double kInkShare = 0.5;    // of the way from ink to paper
  constexpr double kTipWidths = 0.75;  // of a pencil's stroke: its ragged tip may end so far before where its sides meet
  const std::optional<float> width = contour.points[corner.pointIndex].widthPx;
  if (contour.kind != ContourKind::Centreline || !width || page.pixels.empty()) return true;
  std::vector<double> ink;
  const int n = static_cast<int>(contour.points.size());
  for (int k = -kBesidePoints; k <= kBesidePoints; ++k) {
    const int i = contour.closed ? wrapIndex(corner.pointIndex + k, n) : corner.pointIndex + k;
    if (i >= 0 && i < n) ink.push_back(greyAround(page, contour.points[i].at, 1.0).darkest);
  }
  const double dark = upperMedian(ink), light = greyAround(page, corner.positionPx, kPaperReach * *width).lightest;
  const bool isSketched = !contour.points[corner.pointIndex].sigmaPx;
  const double reachPx = isSketched ? std::max(1.0, kTipWidths * static_cast<double>(*width)) : 1.0;
  return greyAround(page, corner.positionPx, reachPx).darkest <= dark + kInkShare * (light - dark);
}

}  // namespace

std::vector<CornerSuggestion> suggestCornersAndCuts(const ContourSet& set, double minAngleRad, double scalePx,
                                                    const RunContext& context) {
  std::vector<std::vector<SharpFeature>> found(set.contours.size());
  parallelFor(context, static_cast<int>(found.size()), 1, [&](int begin, int end) {
    for (int c = begin; c < end && !context.isCancelled(); ++c) {
      const Contour& contour = set.contours[c];
      ConstructPiece piece;
      const std::vector<Vec2> positions = positionsOf(contour.points);
      piece.points = piecePoints(positions);
      // What is as small as this and round is as sharp as a cut all over.
      if (contour.closed && polylineLength(positions, true) < kSmallLoopPx) continue;
      piece.closed = contour.closed;
      for (const PointRange& range : sharpFeatures(piece, contour.kind == ContourKind::Centreline, {}))
        found[c].push_back({c, range.first, range.last});
    }
  });
  std::vector<SharpFeature> features;
  for (const auto& some : found) features.insert(features.end(), some.begin(), some.end());
  return suggestCorners(set, minAngleRad, scalePx, context, features);
}

std::vector<CornerSuggestion> possibleCorners(const ContourSet& set, const RunContext& context) {
  std::vector<CornerSuggestion> all = suggestCornersAndCuts(set, kCertainAngleRad, kCertainScalePx, context);
  for (const CornerSuggestion& corner : cornersOfShortSides(set, all, context)) {
    std::erase_if(all, [&](const CornerSuggestion& other) {
      return other.contour == corner.contour && other.certainty < kCertainCorner &&
             (other.positionPx - corner.positionPx).norm() < kOneTurnPlacePx;
    });
    all.push_back(corner);
  }
  std::ranges::stable_sort(all, {}, &CornerSuggestion::contour);
  return all;
}

std::vector<Corner> certainCorners(const ContourSet& set, const GreyImage& page, std::span<const Vec2> refusedPx,
                                   double reachPx, const RunContext& context) {
  std::vector<Corner> corners;
  // Lines of pen and import have none; where there are no others, thousands of turns are not looked at for nothing.
  const bool anyFound =
      std::any_of(set.contours.begin(), set.contours.end(), [](const Contour& line) { return !isDrawn(line.kind); });
  if (!anyFound) return corners;
  for (const CornerSuggestion& s : possibleCorners(set, context)) {
    if (s.certainty < kCertainCorner || isDrawn(set.contours[s.contour].kind)) continue;
    if (!liesOnInk(s, set.contours[s.contour], page)) continue;
    Corner corner;
    corner.contour = s.contour;
    corner.pointIndex = s.pointIndex;
    corner.positionPx = s.positionPx;
    corner.turningAngleRad = s.turningAngleRad;
    corner.isLocated = s.isLocated;
    corners.push_back(corner);
  }
  for (const Vec2& place : refusedPx) {
    double least = reachPx;
    std::optional<std::ptrdiff_t> refused;
    for (std::ptrdiff_t i = 0; i < std::ssize(corners); ++i) {
      const double distance = (corners[i].positionPx - place).norm();
      if (distance <= least) least = distance, refused = i;
    }
    if (refused) corners.erase(corners.begin() + *refused);
  }
  return corners;
}

}  // namespace batten
