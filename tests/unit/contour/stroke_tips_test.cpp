// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/trace_contours.h"
#include "tests/support/angles.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using test::kDeg;

/// The legs of a stroke are one body of ink for tens of pixels before a very sharp tip, and its centre line turns back
/// there: the tip is where the legs lead to.
TEST(CornerMarks, SharpTipsOfStrokesAreFound) {
  constexpr int kSize = 500;
  for (const double opening : {14.5, 20.0, 33.0}) {
    const Vec2 tip(450.3, 250.4), half(std::cos(0.5 * opening * kDeg), std::sin(0.5 * opening * kDeg));
    const std::vector<Vec2> line{tip - 400.0 * half, tip, tip - 400.0 * Vec2(half.x(), -half.y())};
    const Scan scan =
        test::renderPage(test::strokeCoverage(line, false, 5.0, kSize, kSize), kSize, kSize, test::scannedPage(3));
    BitImage ink(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) ink.set(x, y, scan.grey.level(x, y) < 0.55 * (255.0 - 115.0 * x / kSize));
    EdgeParams edges;
    edges.mode = EdgeMode::Centreline;
    const auto set = traceContours(ink, scan.grey, edges, {}, {});
    ASSERT_TRUE(set.has_value());
    for (const double direction : {0.0, 90.0, 200.0}) {
      const std::vector<CornerMark> marks{{tip + 8.0 * Vec2(std::cos(direction * kDeg), std::sin(direction * kDeg))}};
      const auto pieces = splitAtCorners(*set, marks, {}, {});
      ASSERT_TRUE(pieces.has_value());
      ASSERT_EQ(pieces->corners.size(), 1u) << opening << ", clicked at " << direction;
      EXPECT_LE((pieces->corners[0].positionPx - tip).norm(), 0.5) << opening << ", clicked at " << direction;
    }
  }
}

}  // namespace
}  // namespace batten
