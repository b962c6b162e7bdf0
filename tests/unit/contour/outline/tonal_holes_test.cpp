// SPDX-License-Identifier: GPL-3.0-or-later
// Inner borders of pencilled areas: windows that were drawn stay, highlights and the ends of hatching go.

#include "core/contour/outline/tonal_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace batten {
namespace {

constexpr int kTonePageSide = 300;
constexpr double kBarePaper = 230.0, kPencilTone = 100.0, kPencilledPx = 6.0;

GreyImage tonePage(const std::function<double(double x, double y)>& level) {
  GreyImage page(kTonePageSide, kTonePageSide);
  for (int y = 0; y < kTonePageSide; ++y)
    for (int x = 0; x < kTonePageSide; ++x)
      page.row(y)[x] = static_cast<std::uint16_t>(GreyImage::kGreyUnit * level(x + 0.5, y + 0.5));
  return page;
}

/// The corners of a border, with a point a pixel between them.
Contour borderOf(const std::vector<Vec2>& corners, bool hole) {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &from = corners[i], &to = corners[(i + 1) % corners.size()];
    const int steps = std::max(1, static_cast<int>((to - from).norm()));
    for (int k = 0; k < steps; ++k) points.push_back(from + (to - from) * (static_cast<double>(k) / steps));
  }
  Contour c;
  c.kind = ContourKind::Outline;
  c.closed = true;
  c.hole = hole;
  c.pencilPx = kPencilledPx;
  c.points = contourPoints(points, true);
  measureContour(c);
  return c;
}

/// Ink lies to the right of travel: outer borders run clockwise, as one sees them, holes the other way round.
Contour circleOf(const Vec2& centre, double radius, bool hole) {
  std::vector<Vec2> corners;
  const int n = 90;
  for (int k = 0; k < n; ++k) {
    const double a = (hole ? -2.0 : 2.0) * std::numbers::pi * k / n;
    corners.push_back(centre + radius * Vec2(std::cos(a), std::sin(a)));
  }
  return borderOf(corners, hole);
}

const Vec2 kToneMiddle(150.0, 150.0);

int holesLeft(std::vector<Contour> contours, const GreyImage& page) {
  ContourSet set;
  set.contours = std::move(contours);
  const auto before = std::ssize(set.contours);
  dropTonalHoles(set, page, {});
  EXPECT_EQ(set.report.droppedHoles, before - std::ssize(set.contours));
  return static_cast<int>(
      std::count_if(set.contours.begin(), set.contours.end(), [](const Contour& c) { return c.hole; }));
}

GreyImage discWith(double innerLevel) {
  return tonePage([=](double x, double y) {
    const double r = std::hypot(x - kToneMiddle.x(), y - kToneMiddle.y());
    return r > 120.0 ? kBarePaper : r < 50.0 ? innerLevel : kPencilTone;
  });
}

TEST(TonalHoles, AHighlightIsNoneAndAWindowIsOne) {
  const std::vector<Contour> borders{circleOf(kToneMiddle, 120.0, false), circleOf(kToneMiddle, 50.0, true)};
  EXPECT_EQ(holesLeft(borders, discWith(150.0)), 0);
  EXPECT_EQ(holesLeft(borders, discWith(kBarePaper)), 1);
}

TEST(TonalHoles, StayWhereTheUserChoseTheirInkAndInInkOfPens) {
  std::vector<Contour> borders{circleOf(kToneMiddle, 120.0, false), circleOf(kToneMiddle, 50.0, true)};
  borders[1].traceMode.emplace();
  EXPECT_EQ(holesLeft(borders, discWith(150.0)), 1);
  borders[1].traceMode.reset();
  borders[1].pencilPx.reset();
  EXPECT_EQ(holesLeft(borders, discWith(150.0)), 1);
}

// A bright square among strokes that end in it from above and from below, closed where the gaps between them are
// narrow.
TEST(TonalHoles, TheEndsOfHatchingAreNone) {
  constexpr double kPeriod = 12.0, kTop = 120.0, kBottom = 180.0, kReach = 30.0, kLeft = 60.0, kRight = 240.0;
  const auto isStroke = [=](double x) { return std::fmod(x, kPeriod) < kPencilledPx; };
  const GreyImage hatched = tonePage([=](double x, double y) {
    const bool isBright = y > kTop && y < kBottom && x > kLeft && x < kRight;
    return !isBright && isStroke(x) ? kPencilTone : kBarePaper;
  });
  std::vector<Vec2> teeth;
  for (double x = kLeft; x < kRight; x += kPeriod) {
    for (const Vec2& p : {Vec2(x, kBottom), Vec2(x + kPencilledPx, kBottom), Vec2(x + kPencilledPx, kBottom + kReach),
                          Vec2(x + kPeriod, kBottom + kReach)})
      teeth.push_back(p);
  }
  for (double x = kRight; x > kLeft; x -= kPeriod) {
    for (const Vec2& p : {Vec2(x, kTop - kReach), Vec2(x - kPencilledPx, kTop - kReach), Vec2(x - kPencilledPx, kTop),
                          Vec2(x - kPeriod, kTop)})
      teeth.push_back(p);
  }
  const Contour outer = borderOf({{0.0, 0.0}, {300.0, 0.0}, {300.0, 300.0}, {0.0, 300.0}}, false);
  EXPECT_EQ(holesLeft({outer, borderOf(teeth, true)}, hatched), 0);
  // In an even tone the square was drawn.
  const GreyImage even = tonePage([=](double x, double y) {
    return y > kTop && y < kBottom && x > kLeft && x < kRight ? kBarePaper : kPencilTone;
  });
  const Contour square = borderOf({{kLeft, kBottom}, {kRight, kBottom}, {kRight, kTop}, {kLeft, kTop}}, true);
  EXPECT_EQ(holesLeft({outer, square}, even), 1);
}

}  // namespace
}  // namespace batten
