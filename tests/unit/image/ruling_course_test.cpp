// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_course.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/image/ruled_page.h"

namespace batten {
namespace {

using test::covered;
using test::kRuledHeight;
using test::kRuledWidth;
using test::layer;
using test::light;
using test::paperWith;

// Paper that bends at its sides, and a stroke across: the line leaves its course by three pixels within 110.
TEST(RulingCourse, GoesWithALineThatBendsAway) {
  const auto truth = [](double x) {
    return 100.0 + 0.03 * std::max(0.0, std::fabs(x - 0.5 * kRuledWidth) - 0.35 * kRuledWidth);
  };
  const auto line = layer([&](double x, double y) { return covered(y - truth(x), 1.8); });
  const auto stroke = layer([](double x, double y) { return covered(x - 705.0 - 0.4 * (y - 100.0), 6.0); });
  const Scan scan = paperWith({{line, light(0.7)}, {stroke, light(0.3)}});
  RulingFamily family{.spacingPx = 31.0, .widthPx = 1.8, .depth = 0.3, .lines = {}};
  family.lines.push_back({{Vec2(0.0, 100.0), Vec2(kRuledWidth, 100.0)}});
  RulingCourse course(scan.grey, family, family.lines.front());
  course.straighten();
  for (int x = 0; x < kRuledWidth; x += 5) EXPECT_NEAR(course.at(x), truth(x + 0.5), 0.9) << x;
}

TEST(RulingCourse, AnyStraightLineOfHalfThePointsIsFound) {
  std::vector<Vec2> points;
  for (int i = 0; i < 7; ++i) points.emplace_back(i, i % 3 == 1 ? 9.0 - 4.0 * i : 2.0 + 0.5 * i);
  EXPECT_NEAR(onLineThrough(points, 8.0), 6.0, 1e-9);
  EXPECT_EQ(onLineThrough({}, 3.0), 0.0);
}

}  // namespace
}  // namespace batten
