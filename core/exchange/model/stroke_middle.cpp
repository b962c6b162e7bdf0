// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/stroke_middle.h"

#include <algorithm>
#include <cmath>

#include "core/curve/arc_length.h"
#include "core/curve/curvature.h"
#include "core/exchange/model/export_check.h"

namespace batten {
namespace {

constexpr double kStepWidths = 0.125;  ///< Of the largest width, from place to place: turns of half a width have 12.
constexpr int kFewestSteps = 8;        ///< Between two places where something may jump.
constexpr int kMostSteps = 2000;       // Limits the size of an outline.
constexpr double kSameShare = 1e-9;    ///< Of the length: places nearer to each other are one.

/// Where the width changes its growth or the curve its polynomial, both ends included.
std::vector<double> breaksOf(const NurbsCurve& curve, const WidthProfile& width, const ArcLength& length) {
  std::vector<double> all;
  for (const double u : curve.breaks()) all.push_back(length.at(u));
  // Profile and curve were measured alike; the last digits may differ.
  const double ratio = length.total() / width.length();
  for (const WidthSample& sample : width.samples) all.push_back(sample.s * ratio);
  std::sort(all.begin(), all.end());
  std::vector<double> breaks{0.0};
  const double near = kSameShare * length.total();
  for (const double s : all)
    if (s > breaks.back() + near && s < length.total() - near) breaks.push_back(s);
  breaks.push_back(length.total());
  return breaks;
}

/// Whether a border would have another direction behind than before.
bool isJump(const MiddlePlace& before, const MiddlePlace& behind) {
  constexpr double kSameRad = 1e-6;  // rounding
  return (before.along - behind.along).norm() > kSameRad || std::abs(before.growth - behind.growth) > kSameRad;
}

/// @param before the last place of the piece that this one goes on from; null: it goes on from none
std::vector<MiddlePlace> middlePlaces(const ExportPiece& piece, const MiddlePlace* before, CancelCheck check) {
  std::vector<MiddlePlace> places;
  const NurbsCurve& curve = piece.curve;
  const ArcLength length(curve);
  if (!(length.total() > 0.0)) return places;
  const double step = kStepWidths * figuresOf(*piece.width).largest;
  const std::vector<double> breaks = breaksOf(curve, *piece.width, length);
  const double ratio = piece.width->length() / length.total();
  for (std::size_t b = 1; b < breaks.size() && !check.isCancelled(); ++b) {
    const double from = breaks[b - 1], to = breaks[b];
    const double wanted = step > 0.0 ? std::ceil((to - from) / step) : 1.0;
    const int steps = static_cast<int>(std::clamp(wanted, double{kFewestSteps}, double{kMostSteps}));
    const double u0 = length.parameter(from), u1 = length.parameter(to);
    const double growth = (piece.width->at(to * ratio) - piece.width->at(from * ratio)) / (to - from);
    for (int i = 0; i <= steps; ++i) {
      const double s = from + (to - from) * i / steps;
      // Just inside the ends, where derivatives are those of this stretch.
      const double u = i == 0 ? u0 : i == steps ? u1 : length.parameter(s);
      const double inside = std::clamp(u, u0 + 1e-9 * (u1 - u0), u1 - 1e-9 * (u1 - u0));
      const auto d = curve.derivatives(inside, 1);
      MiddlePlace place{curve.point(u), Vec2::UnitX(), 0.0, piece.width->at(s * ratio), growth, i == 0};
      const double speed = d[1].norm();
      const MiddlePlace* last = places.empty() ? before : &places.back();
      if (speed > 0.0)
        place.along = d[1] / speed;
      else if (last)
        place.along = last->along;
      place.kappa = curvature(curve, inside).value_or(0.0);
      if (i > 0 || !last || isJump(*last, place)) places.push_back(place);
    }
  }
  return places;
}

}  // namespace

std::vector<StrokeMiddle> strokeMiddles(const ExportCurve& line, CancelCheck check) {
  std::vector<StrokeMiddle> middles;
  bool hasWidthBefore = false;
  for (std::size_t i = 0; i < line.pieces.size(); ++i) {
    const ExportPiece& piece = line.pieces[i];
    if (!piece.width) {
      hasWidthBefore = false;
      continue;
    }
    if (!hasWidthBefore || !doMeet(line.pieces[i - 1].curve, piece.curve)) middles.emplace_back();
    std::vector<MiddlePlace>& places = middles.back().places;
    const auto more = middlePlaces(piece, places.empty() ? nullptr : &places.back(), check);
    places.insert(places.end(), more.begin(), more.end());
    hasWidthBefore = true;
  }
  std::erase_if(middles, [](const StrokeMiddle& middle) { return middle.places.size() < 2; });
  const bool isWhole = std::all_of(line.pieces.begin(), line.pieces.end(), [](const auto& p) { return p.width; });
  if (line.closed && isWhole && middles.size() == 1) middles.front().closed = true;
  return middles;
}

}  // namespace batten
