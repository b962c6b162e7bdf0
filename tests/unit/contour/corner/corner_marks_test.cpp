// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>

#include "core/contour/corner/corner_suggestions.h"
#include "core/contour/trace_contours.h"
#include "tests/support/angles.h"
#include "tests/support/contour_shapes.h"
#include "tests/support/growth.h"
#include "tests/support/pen_lines.h"
#include "tests/unit/contour/corner/corner_lines.h"

namespace batten {
namespace {

using test::CurvedPolygon;
using test::RenderSettings;

using test::circle;
using test::fromPoints;
using test::kDeg;
using test::letterK;
using test::traceShape;

TEST(CornerMarks, CornersOfACurvedLetterAreFoundToATenthOfAPixel) {
  const CurvedPolygon shape = letterK();
  double square = 0.0, worst = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const ContourSet set = traceShape(shape.sampled(), 5.0, seed);
    std::mt19937 random(seed);
    std::vector<CornerMark> marks;
    for (const Vec2& c : shape.corners) {
      const double angle = static_cast<double>(random() % 360) * kDeg;
      marks.push_back({c + 8.0 * Vec2(std::cos(angle), std::sin(angle))});  // a click 8 px away
    }
    const auto pieces = splitAtCorners(set, marks, {}, {});
    ASSERT_TRUE(pieces.has_value());
    ASSERT_EQ(pieces->corners.size(), shape.corners.size());
    EXPECT_TRUE(pieces->lostMarks.empty());
    for (const Corner& corner : pieces->corners) {
      const double e = (corner.positionPx - shape.corners[corner.mark.value()]).norm();
      if (e > 0.3)
        printf("seed %u corner %d error %.3f angle %.1f\n", seed, corner.mark.value(), e,
               corner.turningAngleRad / kDeg);
      square += e * e;
      worst = std::max(worst, e);
      ++count;
    }
    ASSERT_EQ(pieces->pieces.size(), shape.corners.size());
    const std::vector<Vec2> truth = shape.sampled(40);
    for (std::size_t i = 0; i < pieces->pieces.size(); ++i) {
      const Piece& piece = pieces->pieces[i];
      EXPECT_TRUE(piece.startIsCorner && piece.endIsCorner && !piece.closed);
      EXPECT_EQ(piece.points.front().at, pieces->corners[i].positionPx);
      EXPECT_EQ(piece.points.back().at, pieces->corners[(i + 1) % pieces->corners.size()].positionPx);
      for (const PiecePoint& p : piece.points) EXPECT_LE(test::distanceToPolyline(truth, p.at), 0.5);
    }
  }
  printf("corner error rms %.4f worst %.4f (%d corners)\n", std::sqrt(square / count), worst, count);
  EXPECT_LE(std::sqrt(square / count), 0.12);
  EXPECT_LE(worst, 0.5);
}

TEST(CornerMarks, AcuteTipsAreExtended) {
  for (const double halfAngle : {12.0, 20.0, 30.0}) {
    const Vec2 tip(280, 150);
    const double w = 220.0 * std::tan(halfAngle * kDeg);
    const std::vector<Vec2> wedge{tip, {60, 150 + w}, {60, 150 - w}};
    const ContourSet set = traceShape(wedge, 3.0, 2);
    const std::vector<CornerMark> marks{{tip - Vec2(6, 3)}};
    const auto pieces = splitAtCorners(set, marks, {}, {});
    ASSERT_TRUE(pieces.has_value());
    ASSERT_EQ(pieces->corners.size(), 1u) << halfAngle;
    const double e = (pieces->corners[0].positionPx - tip).norm();
    printf("tip half angle %.0f: error %.3f\n", halfAngle, e);
    EXPECT_LE(e, 0.7) << halfAngle;
  }
}

// The filter of the mask eats thin tips away; the legs that are left still say where the tip was.
TEST(CornerMarks, TipsEatenByTheMaskAreExtended) {
  for (const double angle : {24.0, 33.0, 44.0}) {
    const Vec2 tip(280, 150);
    const double w = 220.0 * std::tan(0.5 * angle * kDeg);
    const std::vector<Vec2> wedge{tip, {60, 150 + w}, {60, 150 - w}};
    RenderSettings s;
    s.width = 310;
    s.height = 300;
    s.noise = 3.0;
    const GreyImage grey = renderShape(test::PolygonInside(wedge), s);
    BitImage ink = test::thresholdMask(grey, 135.0);
    const double eaten = 2.5 / std::sin(0.5 * angle * kDeg);  // where the tip is 5 px wide
    for (int y = 0; y < s.height; ++y) {
      for (int x = static_cast<int>(tip.x() - eaten); x < s.width; ++x) ink.set(x, y, false);
    }
    EdgeParams edges;
    edges.mode = EdgeMode::Outline;
    const auto set = traceContours(ink, grey, edges, {}, {});
    ASSERT_TRUE(set.has_value());
    const std::vector<CornerMark> marks{{tip - Vec2(6, 3)}};
    const auto pieces = splitAtCorners(*set, marks, {}, {});
    ASSERT_TRUE(pieces.has_value());
    ASSERT_EQ(pieces->corners.size(), 1u) << angle;
    EXPECT_LE((pieces->corners[0].positionPx - tip).norm(), 0.7) << angle;
  }
}

// Clicks on the far side of such a tip are more than the snap distance from every point of the contour.
TEST(CornerMarks, ClicksBesideEatenTipsFindThem) {
  for (const double angle : {16.0, 24.0, 32.0, 44.0, 52.0}) {
    const Vec2 tip(280, 150);
    const double w = 220.0 * std::tan(0.5 * angle * kDeg);
    RenderSettings s;
    s.width = 310;
    s.height = 300;
    s.noise = 5.0;
    s.seed = 7;
    const GreyImage grey = renderShape(test::PolygonInside({tip, {60, 150 + w}, {60, 150 - w}}), s);
    BitImage ink = test::thresholdMask(grey, 135.0);
    const double eaten = 3.0 / std::sin(0.5 * angle * kDeg);
    for (int y = 0; y < s.height; ++y) {
      for (int x = static_cast<int>(tip.x() - eaten); x < s.width; ++x) ink.set(x, y, false);
    }
    EdgeParams edges;
    edges.mode = EdgeMode::Outline;
    const auto set = traceContours(ink, grey, edges, {}, {});
    ASSERT_TRUE(set.has_value());
    for (const double direction : {0.0, 70.0, 140.0, 220.0, 290.0}) {
      const std::vector<CornerMark> marks{{tip + 8.0 * Vec2(std::cos(direction * kDeg), std::sin(direction * kDeg))}};
      const auto pieces = splitAtCorners(*set, marks, {}, {});
      ASSERT_TRUE(pieces.has_value());
      ASSERT_EQ(pieces->corners.size(), 1u) << angle << " clicked at " << direction;
      EXPECT_LE((pieces->corners[0].positionPx - tip).norm(), angle < 40.0 ? 0.5 : 0.25) << angle << ", " << direction;
      EXPECT_LE(pieces->corners[0].snapPx, 9.0);
    }
  }
}

// Shallow corners: the position along the line is 1 / sin(angle) less certain, so the sides must be used as far as they
// are smooth.
TEST(CornerMarks, ShallowCornersOfLongSides) {
  double square = 0.0;
  int count = 0;
  for (const double turnDeg : {25.0, 35.0, 60.0}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      std::mt19937 random(seed);
      std::normal_distribution<double> gauss(0.0, 1.0);
      std::vector<Vec2> points;
      const Vec2 corner(300, 300), out(std::cos(turnDeg * kDeg), std::sin(turnDeg * kDeg));
      for (int i = 250; i > 0; --i) points.emplace_back(300.0 - i, 300.0 - 0.5 * i * i / 500.0);
      for (int i = 0; i <= 250; ++i) points.push_back(corner + i * out + (0.5 * i * i / 400.0) * leftNormal(out));
      for (Vec2& p : points) p += 0.07 * Vec2(gauss(random), gauss(random));
      Contour c;
      c.points = contourPoints(points, true);
      ContourSet set;
      set.contours.push_back(c);
      const std::vector<CornerMark> marks{{corner + Vec2(-5, 6)}};
      const auto pieces = splitAtCorners(set, marks, {}, {});
      ASSERT_TRUE(pieces.has_value());
      ASSERT_EQ(pieces->corners.size(), 1u);
      square += (pieces->corners[0].positionPx - corner).squaredNorm();
      ++count;
    }
  }
  EXPECT_LE(std::sqrt(square / count), 0.18);
}

TEST(CornerMarks, TurningAngleIsPositiveToTheLeftInTheModelFrame) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 60; ++i) points.emplace_back(i, 100.0);
  for (int i = 1; i <= 60; ++i) points.emplace_back(60.0, 100.0 - i);  // up on the screen: a left turn
  const std::vector<CornerMark> marks{{Vec2(58, 98)}};
  const auto pieces = splitAtCorners(fromPoints(points, false), marks, {}, {});
  ASSERT_TRUE(pieces.has_value());
  ASSERT_EQ(pieces->corners.size(), 1u);
  EXPECT_NEAR(pieces->corners[0].turningAngleRad, 90.0 * kDeg, 1e-6);
  EXPECT_NEAR((pieces->corners[0].positionPx - Vec2(60, 100)).norm(), 0.0, 1e-6);
  ASSERT_EQ(pieces->pieces.size(), 2u);
  EXPECT_FALSE(pieces->pieces[0].startIsCorner);
  EXPECT_EQ(pieces->pieces[0].points.front().at, Vec2(0, 100));
  EXPECT_EQ(pieces->pieces[1].points.back().at, Vec2(60, 40));
}

TEST(CornerMarks, OnASmoothLineTheNearestPointIsTaken) {
  const ContourSet set = fromPoints(circle(60.0), true, 0.07);
  const auto corner = nearestContourPoint(set, {150 + 66, 150}, 16.0);
  ASSERT_TRUE(corner.has_value());
  EXPECT_LE((corner->positionPx - Vec2(210, 150)).norm(), 1.0);
  EXPECT_FALSE(nearestContourPoint(set, {150 + 80, 150}, 16.0).has_value());
  EXPECT_FALSE(nearestContourPoint(ContourSet{}, {0, 0}, 16.0).has_value());
}

TEST(CornerMarks, MarksAnyDistanceAwayFindNoLine) {
  const ContourSet set = fromPoints(circle(60.0), true);
  for (const double far : {1e4, 5e9, 1e12, 1e300, -1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(nearestContourPoint(set, {far, 5.0}, 16.0).has_value()) << far;
    EXPECT_FALSE(nearestContourPoint(set, {5.0, far}, 16.0).has_value()) << far;
  }
}

// What a mark costs does not depend on how much is drawn elsewhere.
TEST(CornerMarks, ManyTakeNoTimeWithTheSizeOfTheDrawing) {
  constexpr int kTeeth = 700;
  constexpr double kToothPx = 16.0;
  std::vector<Vec2> tips;
  std::vector<CornerMark> marks;
  for (int i = 0; i <= kTeeth; ++i) tips.emplace_back(kToothPx * i, (i % 2) * kToothPx);
  for (int i = 1; i < kTeeth; ++i) marks.push_back({tips[i]});
  const Contour zigzag = fromPoints(test::alongPolygon(tips, false), false).contours.front();
  CornerParams params;
  params.exact = false;
  const auto secondsWith = [&](int lines) {
    ContourSet set;
    set.contours.push_back(zigzag);
    for (int i = 0; i < lines; ++i)
      set.contours.push_back(
          fromPoints(test::alongPolygon({{0.0, 200.0 + 4.0 * i}, {5000.0, 200.0 + 4.0 * i}}, false), false)
              .contours.front());
    const auto secondsFor = [&](std::span<const CornerMark> some) {
      return test::secondsOf([&] {
        const auto pieces = splitAtCorners(set, some, params, {});
        EXPECT_TRUE(pieces && pieces->corners.size() == some.size() && pieces->lostMarks.empty());
      });
    };
    return std::min(secondsFor(marks), secondsFor(marks)) - std::min(secondsFor({}), secondsFor({}));
  };
  EXPECT_TRUE(test::growsAtMost(
      3.0, [&] { return secondsWith(0); }, [&] { return secondsWith(200); }))
      << "among a million other points";
}

TEST(CornerMarks, ClosedContours) {
  const ContourSet set = fromPoints(circle(60.0), true);
  const auto smooth = splitAtCorners(set, {}, {}, {});
  ASSERT_TRUE(smooth.has_value());
  ASSERT_EQ(smooth->pieces.size(), 1u);
  EXPECT_TRUE(smooth->pieces[0].closed);
  EXPECT_EQ(positionsOf(smooth->pieces[0].points), positionsOf(set.contours[0].points));
  EXPECT_NEAR(smooth->pieces[0].lengthPx, 2 * std::numbers::pi * 60, 0.05);
  const std::vector<CornerMark> marks{{Vec2(212, 150)}, {Vec2(211, 150)}, {Vec2(400, 400)}};
  const auto one = splitAtCorners(set, marks, {}, {});
  ASSERT_TRUE(one.has_value());
  EXPECT_EQ(one->lostMarks, std::vector<int>{2});
  ASSERT_EQ(one->corners.size(), 1u);  // the second mark found the same place
  EXPECT_EQ(one->sameCorner, (std::vector<MarkPair>{{1, 0, 0.0}}));
  ASSERT_EQ(one->pieces.size(), 1u);
  EXPECT_FALSE(one->pieces[0].closed);
  EXPECT_EQ(one->pieces[0].points.front().at, one->pieces[0].points.back().at);
  EXPECT_NEAR(one->pieces[0].lengthPx, 2 * std::numbers::pi * 60, 1.0);
}

TEST(CornerMarks, TinyAndDegenerateContours) {
  std::vector<std::vector<Vec2>> cases{
      {}, {{1, 1}}, {{1, 1}, {2, 2}}, {{1, 1}, {2, 1}, {2, 2}}, std::vector<Vec2>(20, Vec2(3, 3))};
  for (const auto& points : cases) {
    for (const bool closed : {false, true}) {
      const std::vector<CornerMark> marks{{Vec2(1, 1)}, {Vec2(3, 3)}};
      const auto pieces = splitAtCorners(fromPoints(points, closed), marks, {}, {});
      ASSERT_TRUE(pieces.has_value());
      for (const Piece& piece : pieces->pieces) {
        for (const PiecePoint& p : piece.points) EXPECT_TRUE(p.at.allFinite());
      }
      EXPECT_TRUE(suggestCorners(fromPoints(points, closed), 0.5, 16.0, {}).empty());
    }
  }
}

TEST(CornerMarks, BadSnapDistanceIsRefused) {
  CornerParams params;
  params.snapDistancePx = 0.0;
  EXPECT_FALSE(splitAtCorners({}, {}, params, {}).has_value());
}

}  // namespace
}  // namespace batten
