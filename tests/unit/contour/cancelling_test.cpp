// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/contour/segment/regression_segments.h"

namespace batten {
namespace {

constexpr int kPoints = 300'000;

// A zigzag with a corner every 50 px and a little noise, about a point a pixel.
std::vector<Vec2> zigzag(int points) {
  std::vector<Vec2> line;
  for (int i = 0; i < points; ++i) {
    const int k = i % 100;
    const double up = k < 50 ? k : 100 - k;
    line.push_back({0.7 * i, 0.7 * up + 0.05 * std::sin(12.9898 * i)});
  }
  return line;
}

ContourSet setOf(const std::vector<Vec2>& points) {
  ContourSet set;
  Contour& contour = set.contours.emplace_back();
  contour.points = contourPoints(points, true);
  measureContour(contour);
  return set;
}

// Does work that takes seconds, and cancels it from another thread after a moment. Whoever does not look at the token
// while it works comes to its end all the same.
template <class Work>
auto cancelledInTheMiddle(const Work& work) {
  using Clock = std::chrono::steady_clock;
  RunContext context;
  Clock::time_point asked;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    asked = Clock::now();
    context.cancel.cancel();
  });
  auto result = work(context);
  const auto ended = Clock::now();
  other.join();
  std::printf("heard after %.1f ms\n", std::chrono::duration<double, std::milli>(ended - asked).count());
  return result;
}

TEST(Cancelling, IsHeardWhileLinesAreCutAtMarks) {
  const ContourSet set = setOf(zigzag(kPoints));
  std::vector<CornerMark> marks;
  for (int i = 50; i < kPoints; i += 50) marks.push_back({set.contours[0].points[i].at});
  const auto pieces =
      cancelledInTheMiddle([&](const RunContext& context) { return splitAtCorners(set, marks, {}, context); });
  ASSERT_FALSE(pieces.has_value());
  EXPECT_EQ(pieces.error().code, ErrorCode::Cancelled);
}

TEST(Cancelling, IsHeardWhileCornersAreLocated) {
  const ContourSet set = setOf(zigzag(2000));
  std::vector<CornerMark> marks;
  for (int i = 50; i < 2000; i += 50) marks.push_back({set.contours[0].points[i].at});
  RunContext stopped;
  stopped.cancel.cancel();
  EXPECT_FALSE(splitAtCorners(set, marks, {}, stopped).has_value());
  const auto whole = splitAtCorners(set, marks, {}, {});
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->pieces.size(), marks.size() + 1) << "every mark stands on a corner of its own";
}

TEST(Cancelling, IsHeardWhileStationsAreLaid) {
  PieceSet set;
  Piece& piece = set.pieces.emplace_back();
  piece.points = piecePoints(zigzag(kPoints));
  SegmentParams params;
  params.mode = SegmentMode::Adaptive;
  params.tolerancePx = 0.02;
  const auto segments =
      cancelledInTheMiddle([&](const RunContext& context) { return regressionSegments(set, params, context); });
  ASSERT_FALSE(segments.has_value());
  EXPECT_EQ(segments.error().code, ErrorCode::Cancelled);
}

TEST(Cancelling, IsHeardWhileCornersAreSuggested) {
  constexpr double kAngle = 0.6, kScale = 14.0;
  const std::vector<CornerSuggestion> few = suggestCorners(setOf(zigzag(2000)), kAngle, kScale, {});
  ASSERT_GT(few.size(), 30u);
  const ContourSet set = setOf(zigzag(kPoints));
  const auto found =
      cancelledInTheMiddle([&](const RunContext& context) { return suggestCorners(set, kAngle, kScale, context); });
  EXPECT_TRUE(found.empty());
  std::vector<CornerSuggestion> all;
  for (int i = 50; i < kPoints; i += 50) all.push_back({0, i, set.contours[0].points[i].at, 1.57});
  const auto kept =
      cancelledInTheMiddle([&](const RunContext& context) { return oncePerCorner(set, all, 16.0, context); });
  EXPECT_LT(kept.size(), all.size());
}

}  // namespace
}  // namespace batten
