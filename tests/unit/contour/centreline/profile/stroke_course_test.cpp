// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/profile/stroke_course.h"

#include <gtest/gtest.h>

#include "core/contour/centreline/ends/stroke_ends.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

// Both ends of a stroke lie beyond the skeleton that it was found by, so that points are added at either end: those
// that were measured keep the tone that was measured at them.
TEST(StrokeCourse, EndsAreMovedWithoutMovingTones) {
  constexpr int kWidth = 200, kHeight = 60;
  const std::vector<Vec2> middle{{30.0, 30.0}, {170.0, 30.0}};
  const Scan scan = test::renderPage(test::strokeCoverage(middle, false, 6.0, kWidth, kHeight), kWidth, kHeight, {});
  StrokePath path;
  for (int x = 45; x <= 150; ++x) path.points.push_back({Vec2(x, 30.0), 3.0f, StrokePart::Ink});
  StrokeCourse course = resample(path);
  const int before = course.count();
  for (CoursePoint& p : course.points) p.tone = {.contrast = static_cast<float>(p.base.x())};
  const FreeEnds ends = findEnds(course, scan.grey, false);
  placeEnds(course, ends, cutOddsOf({ends}));
  ASSERT_GT(course.count(), before + 10) << "both ends were to move";
  for (const CoursePoint& p : course.points) {
    if (p.base.x() < 55.0 || p.base.x() > 140.0) continue;
    ASSERT_TRUE(p.tone);
    EXPECT_NEAR(p.tone->contrast, p.base.x(), 0.01);
  }
}

}  // namespace
}  // namespace batten
