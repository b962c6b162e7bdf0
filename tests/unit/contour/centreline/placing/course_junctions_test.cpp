// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/placing/course_junctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contour/centreline/centreline.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

constexpr int kStripWidth = 400, kStripHeight = 160;

// What several pens have inked one over the other, scanned.
Contour lineOf(const std::vector<std::vector<float>>& inks) {
  const test::InkPage page = test::scannedInks(inks, kStripWidth, kStripHeight, 4.0);
  const auto set = centrelines(page.ink, page.grey, {}, {});
  EXPECT_TRUE(set && !set->contours.empty());
  if (!set || set->contours.empty()) return {};
  return *std::ranges::max_element(set->contours, {}, [](const Contour& c) { return c.lengthPx; });
}

std::vector<float> stroke(const std::vector<Vec2>& line, double widthPx) {
  return test::strokeCoverage(line, false, widthPx, kStripWidth, kStripHeight);
}
std::vector<float> disc(const Vec2& centre, double radiusPx) {
  std::vector<Vec2> outline;
  for (int k = 0; k < 90; ++k) {
    const double angle = 0.0698131700797732 * k;
    outline.push_back(centre + radiusPx * Vec2(std::cos(angle), std::sin(angle)));
  }
  return test::fillCoverage(outline, kStripWidth, kStripHeight);
}

// [px] How far a line lies from y at the most, its ends left out, and the steepest it goes over 4 px.
struct Course {
  double offPx = 0.0, steepest = 0.0;
};
Course along(const Contour& line, double y) {
  constexpr int kStep = 4;
  constexpr double kEndsPx = 20.0;
  Course found;
  for (int i = kStep; i + kStep < std::ssize(line.points); ++i) {
    const Vec2& at = line.points[i].at;
    if (at.x() < 40.0 + kEndsPx || at.x() > 360.0 - kEndsPx) continue;
    found.offPx = std::max(found.offPx, std::abs(at.y() - y));
    const Vec2 step = line.points[i + kStep / 2].at - line.points[i - kStep / 2].at;
    found.steepest = std::max(found.steepest, std::abs(step.y()) / std::abs(step.x()));
  }
  return found;
}

TEST(Blots, ALineGoesThroughABlotAsThePenDid) {
  const double y = 80.3;
  for (const double aside : {0.0, 5.0, 8.0}) {
    const Contour line = lineOf({stroke({{40.0, y}, {360.0, y}}, 8.0), disc({200.0, y - aside}, 10.0)});
    const Course course = along(line, y);
    EXPECT_LT(course.offPx, 1.0) << aside;
    EXPECT_LT(course.steepest, 0.1) << aside;
  }
}

TEST(Blots, AStrokeThatSwellsSlowlyKeepsItsMiddle) {
  // A leaf: one border is straight, the other an arc, so that the middle is half as high as the arc.
  constexpr double kY = 100.0, kThin = 6.0, kSwell = 14.0, kFrom = 40.0, kTo = 360.0;
  const auto arc = [&](double x) { return kSwell * std::pow(std::sin(M_PI * (x - kFrom) / (kTo - kFrom)), 2); };
  std::vector<Vec2> outline{{kFrom, kY}, {kTo, kY}};
  for (double x = kTo; x >= kFrom; x -= 2.0) outline.emplace_back(x, kY - kThin - arc(x));
  const Contour line = lineOf({test::fillCoverage(outline, kStripWidth, kStripHeight)});
  for (const ContourPoint& p : line.points) {
    if (p.at.x() < kFrom + 30.0 || p.at.x() > kTo - 30.0) continue;
    EXPECT_NEAR(p.at.y(), kY - 0.5 * (kThin + arc(p.at.x())), 0.4) << p.at.x();
  }
}

TEST(Jogs, AStrokeSetOnAnewBesideItsEndGoesOnGently) {
  const double y = 80.0;
  for (const double aside : {2.0, 3.6, 4.5}) {
    const Contour line = lineOf({stroke({{40.0, y - 0.5 * aside}, {205.0, y - 0.5 * aside}}, 9.0),
                                 stroke({{195.0, y + 0.5 * aside}, {360.0, y + 0.5 * aside}}, 9.0)});
    ASSERT_GT(line.lengthPx, 300.0) << aside;
    const Course course = along(line, y);
    EXPECT_LT(course.offPx, 0.5 * aside + 0.5) << aside;
    EXPECT_LT(course.steepest, 0.24) << aside;
  }
}

TEST(Jogs, WavesWiderThanThePenStay) {
  // A swing of a pen's width to either side within eight: as small as a hand can draw it.
  constexpr double kPen = 5.0;
  std::vector<Vec2> wave;
  for (double x = 40.0; x <= 360.0; x += 1.0)
    wave.emplace_back(x, 80.0 + kPen * std::sin(2.0 * M_PI * x / (8.0 * kPen)));
  const Contour line = lineOf({stroke(wave, kPen)});
  double most = 0.0;
  for (const ContourPoint& p : line.points) {
    if (p.at.x() < 60.0 || p.at.x() > 340.0) continue;
    double off = 1e9;
    for (const Vec2& w : wave) off = std::min(off, (w - p.at).norm());
    most = std::max(most, off);
  }
  EXPECT_LT(most, 0.8);
}

TEST(StrokeStubs, AShortStemStandsOutOfABowl) {
  // The stem of a b goes on past its bowl for a width and a half; a bump of half a width is the bowl's own.
  constexpr double kPen = 5.0;
  std::vector<Vec2> bowl;
  for (int k = 0; k <= 90; ++k) {
    const double angle = 0.0698131700797732 * k;
    bowl.push_back(Vec2(210.0, 90.0) + Vec2(14.0 * std::cos(angle), 14.0 * std::sin(angle)));
  }
  for (const bool isStem : {true, false}) {
    const double top = 90.0 - 14.0 - (isStem ? 1.5 : 0.1) * kPen;
    const Contour line = lineOf({stroke(bowl, kPen), stroke({{197.0, 106.0}, {197.0, top}}, kPen)});
    double highest = 1e9;
    for (const ContourPoint& p : line.points)
      if (p.at.x() < 202.0) highest = std::min(highest, p.at.y());
    EXPECT_GT(highest, top - 0.6 * kPen);
    EXPECT_LT(highest, top + (isStem ? 0.5 : 2.0) * kPen);
  }
}

TEST(StrokeStubs, TheLegsOfAnAGoOnBelowItsBar) {
  // The bar and the upper half of a leg make an acute corner, from which the lower half points away; the bar is too
  // short for a direction.
  constexpr double kTop = 30.0, kSpread = 0.3, kBarPens = 4.2, kFootPens = 6.0;
  const auto leg = [](double side, double y) { return Vec2(200.0 + side * kSpread * (y - kTop), y); };
  for (const double pen : {7.0, 9.0, 11.0}) {
    const double bar = kTop + kBarPens * pen, foot = kTop + kFootPens * pen;
    const test::InkPage page = test::scannedInks(
        {stroke({leg(-1.0, foot), leg(0.0, kTop), leg(1.0, foot)}, pen), stroke({leg(-1.0, bar), leg(1.0, bar)}, pen)},
        kStripWidth, kStripHeight, 4.0);
    const auto set = centrelines(page.ink, page.grey, {}, {});
    ASSERT_TRUE(set) << pen;
    for (const double side : {-1.0, 1.0}) {
      for (const double y : {0.5 * (bar + foot), foot - 0.25 * pen}) {
        double nearest = 1e9;
        for (const Contour& c : set->contours)
          for (const ContourPoint& p : c.points) nearest = std::min(nearest, (p.at - leg(side, y)).norm());
        EXPECT_LT(nearest, 0.3 * pen) << pen << " " << side << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace batten
