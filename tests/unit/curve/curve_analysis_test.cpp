// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/curvature_jump.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/curve/knot_operations.h"
#include "tests/support/known_answers.h"
#include "tests/unit/curve/curve_samples.h"

namespace batten {
namespace {

using std::numbers::pi;

/// An ellipse as closed uniform quintic of `n` control points, good to about 1e-5 of its size for n = 40.
NurbsCurve ellipse(double a, double b, int n, double phase) {
  std::vector<Vec2> points;
  for (int i = 0; i < n + 5; ++i) {
    const double t = phase + 2 * pi * i / n;
    points.emplace_back(a * std::cos(t), b * std::sin(t));
  }
  return test::uniformCurve(5, points);
}

TEST(Curvature, MatchesTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "03_curvature.json");
  const auto curve = test::uniformCurve(5, test::toPoints(answer.at("control_points")));
  for (std::size_t i = 0; i < answer.at("t").size(); ++i) {
    const double t = answer.at("t").at(i);
    const auto d = curve.derivatives(t, 2);
    const auto near = [](const Vec2& got, const Vec2& want) { return (got - want).norm() <= 1e-9 * want.norm(); };
    EXPECT_TRUE(near(d[0], test::toVec2(answer.at("R").at(i))));
    EXPECT_TRUE(near(d[1], test::toVec2(answer.at("R1").at(i))));
    EXPECT_TRUE(near(d[2], test::toVec2(answer.at("R2").at(i))));
    const double kappa = answer.at("kappa").at(i);
    EXPECT_NEAR(curvature(curve, t).value(), kappa, 1e-9 * kappa);
  }
  const ArcLength length(curve);
  EXPECT_NEAR(length.total(), answer.at("length").get<double>(), 1e-7);
  for (std::size_t i = 0; i < answer.at("arc_fraction").size(); ++i) {
    const double u = length.parameter(answer.at("arc_fraction").at(i).get<double>() * length.total());
    EXPECT_NEAR(u, answer.at("t_at_arc_fraction").at(i).get<double>(), 1e-9);
    const double kappa = answer.at("kappa_at_arc_fraction").at(i);
    EXPECT_NEAR(curvature(curve, u).value(), kappa, 1e-8 * kappa);
  }
}

TEST(Curvature, SignAndSizeOnCircles) {
  const auto left = test::circle(12.0, {3, 4});
  for (const double u : test::parametersOf(left)) {
    EXPECT_NEAR(curvature(left, u).value(), 1.0 / 12.0, 1e-12);
    EXPECT_NEAR(curvature(reversed(left), u).value(), -1.0 / 12.0, 1e-12);
    EXPECT_NEAR(curvatureSlope(left, u).value(), 0.0, 1e-12);
  }
}

TEST(Curvature, SlopeIsTheDifferenceOverArcLength) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = test::randomCurve(random, 5, true, trial % 2 == 0);
    const auto breaks = curve.breaks();
    const double u = 0.6 * breaks[0] + 0.4 * breaks[1], h = 1e-5 * (breaks[1] - breaks[0]);
    const double speed = curve.derivatives(u, 1)[1].norm();
    const double difference = (curvature(curve, u + h).value() - curvature(curve, u - h).value()) / (2 * h * speed);
    const double slope = curvatureSlope(curve, u).value();
    EXPECT_NEAR(slope, difference, 1e-5 * (std::abs(slope) + std::abs(curvature(curve, u).value()) * 0.01));
  }
}

TEST(Curvature, AbsentWhereTheCurveStandsStill) {
  const auto cusp = NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {1, 1}, {0, 1}, {1, 0}}).value();
  EXPECT_FALSE(curvature(cusp, 0.5).has_value());
  EXPECT_FALSE(curvatureSlope(cusp, 0.5).has_value());
  EXPECT_TRUE(curvature(cusp, 0.4).has_value());
  const auto point = NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{9, 9}, {9, 9}, {9, 9}}).value();
  EXPECT_FALSE(curvature(point, 0.3).has_value());
  EXPECT_TRUE(curvatureExtrema(point, 1e-6, false).empty());
  EXPECT_NEAR(ArcLength(point).total(), 0.0, 1e-13);
  EXPECT_NEAR(closestPoint(point, {9, 10}).distance, 1.0, 1e-13);
  for (const auto& sample : sampleByArcLength(point, 5)) EXPECT_LT((sample.point - Vec2(9, 9)).norm(), 1e-13);
}

TEST(ArcLength, KnownCurves) {
  EXPECT_NEAR(ArcLength(test::circle(10, {0, 0})).total(), 20 * pi, 1e-9);
  const double a = 3.0, r = 0.5;  // y = x^2 / (2 r), r = 0.5: y = x^2
  const double exact = a * std::sqrt(1 + 4 * a * a) + std::asinh(2 * a) / 2;
  EXPECT_NEAR(ArcLength(test::parabola(r, a)).total(), exact, 1e-10 * exact);
  // A curve that turns back in a cusp: both branches count.
  const auto fold = NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{0, 0}, {2, 0}, {0, 0}}).value();
  EXPECT_NEAR(ArcLength(fold).total(), 2.0, 1e-9);
}

TEST(ArcLength, InverseAndDenseSumAgree) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = test::randomCurve(random, 2 + trial % 6, trial % 2 == 0, trial % 3 == 0);
    const ArcLength length(curve);
    double polygon = 0.0;
    const auto breaks = curve.breaks();
    constexpr int kSteps = 3000;
    for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
      Vec2 last = curve.point(breaks[span]);
      for (int i = 1; i <= kSteps; ++i) {
        const Vec2 next = curve.point(breaks[span] + (breaks[span + 1] - breaks[span]) * i / kSteps);
        polygon += (next - last).norm();
        last = next;
      }
    }
    EXPECT_NEAR(length.total(), polygon, 1e-5 * polygon);
    double before = curve.start() - 1.0;
    for (int i = 0; i <= 50; ++i) {
      const double s = length.total() * i / 50.0, u = length.parameter(s);
      EXPECT_NEAR(length.at(u), s, 1e-10 * length.total());
      EXPECT_GT(u, before);
      before = u;
    }
    EXPECT_EQ(length.at(curve.start() - 1), 0.0);
    EXPECT_EQ(length.at(curve.end() + 1), length.total());
    EXPECT_EQ(length.parameter(-1.0), curve.start());
    EXPECT_EQ(length.parameter(2 * length.total()), curve.end());
  }
}

TEST(SampleByArcLength, StepsAreEqual) {
  const auto circle = test::circle(5, {1, 2});
  const auto samples = sampleByArcLength(circle, 101);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_NEAR((samples[i].point - samples[i - 1].point).norm(), 2 * 5 * std::sin(pi / 100), 1e-9);
    EXPECT_NEAR(samples[i].kappa, 0.2, 1e-10);
    EXPECT_NEAR(samples[i].tangent.norm(), 1.0, 1e-14);
  }
}

TEST(ClosestPoint, FindsBothSidesOfACorner) {
  // Two Bezier pieces that meet at an acute corner: a place on one side has samples of the other side near it.
  const NurbsCurve curve =
      NurbsCurve::make(
          5, {0, 0, 0, 0, 0, 0, 20, 20, 20, 20, 20, 40, 40, 40, 40, 40, 40},
          {{5, 60}, {9, 64}, {13, 66}, {17, 66}, {21, 64}, {25, 60}, {29, 68}, {33, 72}, {37, 74}, {41, 73}, {45, 70}})
          .value();
  for (int i = 0; i <= 3000; ++i) {
    const double u = 40.0 * i / 3000;
    EXPECT_LT(closestPoint(curve, curve.point(u)).distance, 1e-9) << u;
  }
}

TEST(ClosestPoint, NotFartherThanAnyOfManySamples) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> where(-100, 300);
  for (int trial = 0; trial < 30; ++trial) {
    const auto curve = test::randomCurve(random, 1 + trial % 7, trial % 2 == 0, trial % 3 == 0);
    for (int k = 0; k < 20; ++k) {
      const Vec2 p(where(random), where(random));
      const auto found = closestPoint(curve, p);
      EXPECT_LT((curve.point(found.u) - found.point).norm(), 1e-12);
      EXPECT_NEAR((found.point - p).norm(), found.distance, 1e-12);
      for (int i = 0; i <= 3000; ++i) {
        const double u = curve.start() + (curve.end() - curve.start()) * i / 3000.0;
        ASSERT_GE((curve.point(u) - p).norm(), found.distance - 1e-9);
      }
    }
  }
}

TEST(Deviation, OrderedEqualsUnorderedAndTheTruth) {
  const auto circle = test::circle(50, {0, 0});
  std::vector<Vec2> points;
  std::mt19937 random(8);
  std::normal_distribution<double> noise(0.0, 0.2);
  std::vector<double> offsets;
  for (int i = 0; i < 2000; ++i) {
    const double t = 2 * pi * (i + 300) / 2000.0, off = noise(random);  // Starts away from the seam and crosses it.
    offsets.push_back(std::abs(off));
    points.emplace_back((50 + off) * std::cos(t), (50 + off) * std::sin(t));
  }
  const auto quick = deviation(circle, points, true), slow = deviation(circle, points, false);
  std::sort(offsets.begin(), offsets.end());
  double sum = 0;
  for (const double o : offsets) sum += o * o;
  for (const auto& d : {quick, slow}) {
    EXPECT_EQ(d.count, 2000);
    EXPECT_NEAR(d.max, offsets.back(), 1e-9);
    EXPECT_NEAR(d.rms, std::sqrt(sum / 2000), 1e-9);
    EXPECT_NEAR(d.percentile95, offsets[1899], 1e-9);
    EXPECT_NEAR(std::abs(d.worstPoint.norm() - 50), d.max, 1e-9);
  }
  EXPECT_EQ(deviation(circle, std::vector<Vec2>{}, true).count, 0);
  EXPECT_NEAR(deviation(test::circle(49, {0, 0}), circle).max, 1.0, 1e-9);
}

TEST(CurvatureExtrema, EllipseHasFour) {
  for (const double phase : {0.0, 0.3, 1.0, 2.0}) {
    const auto curve = ellipse(100, 60, 40, phase);
    const auto extrema = curvatureExtrema(curve, 5e-3 / extent(curve), true);
    ASSERT_EQ(extrema.size(), 4u) << phase;
    for (const auto& e : extrema) {
      const Vec2 p = curve.point(e.u);
      EXPECT_NEAR(std::abs(e.maximum ? p.y() : p.x()), 0.0, 5e-3);
      EXPECT_NEAR(e.kappa, e.maximum ? 100.0 / 3600 : 60.0 / 10000, 1e-2 * e.kappa);
      EXPECT_NEAR(e.s, ArcLength(curve).at(e.u), 1e-9);
    }
  }
}

TEST(CurvatureExtrema, ParabolaOneLineNoneCircleNone) {
  const auto one = curvatureExtrema(test::parabola(2.0, 3.0), 1e-3, false);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].u, 0.5, 1e-9);
  EXPECT_NEAR(one[0].kappa, 0.5, 1e-12);
  EXPECT_TRUE(one[0].maximum);
  EXPECT_TRUE(curvatureExtrema(test::circle(5, {0, 0}), 1e-9, true).empty());
  const auto line = NurbsCurve::make(1, {0, 0, 1, 1}, {{0, 0}, {9, 4}}).value();
  EXPECT_TRUE(curvatureExtrema(line, 1e-9, false).empty());
}

TEST(CurvatureExtrema, CountsExactlyThoseAboveTheProminence) {
  // y = sin x: extrema of the curvature at each crest and trough; the first and last are inside the curve.
  std::vector<Vec2> points;
  for (int i = -10; i < 205; ++i) points.emplace_back(0.1 * i, 10 * std::sin(0.1 * i));
  const auto curve = test::uniformCurve(5, points);
  const auto extrema = curvatureExtrema(curve, 1.0, false);
  const double from = curve.point(curve.start()).x(), to = curve.point(curve.end()).x();
  int crests = 0, crossings = 0;
  for (int k = -2; k < 20; ++k) {
    const double x = pi / 2 + k * pi;
    crests += x > from && x < to;
    crossings += k * pi > from && k * pi < to;
  }
  EXPECT_EQ(static_cast<int>(extrema.size()), crests);
  EXPECT_TRUE(curvatureExtrema(curve, 25.0, false).empty());
  EXPECT_EQ(static_cast<int>(inflections(curve, 0.01, false).size()), crossings);
}

TEST(CurvatureExtrema, NarrowPeakIsNotMissed) {
  // Two straight arms with a sharp bend inside one span.
  const auto bend =
      NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{-100, 100}, {0.02, 0}, {-0.02, 0}, {100, 100}}).value();
  const auto extrema = curvatureExtrema(bend, 1e-3, false);
  ASSERT_GE(extrema.size(), 1u);
  bool found = false;
  for (const auto& e : extrema) found = found || std::abs(e.u - 0.5) < 1e-6;
  EXPECT_TRUE(found);
}

TEST(Inflections, CubicAndClosedEight) {
  const auto s = NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {1, 1}, {2, -1}, {3, 0}}).value();
  const auto at = inflections(s, 1e-6, false);
  ASSERT_EQ(at.size(), 1u);
  EXPECT_NEAR(at[0], 0.5, 1e-10);
  std::vector<Vec2> eight;
  for (int i = 0; i < 45; ++i) eight.emplace_back(50 * std::sin(2 * pi * i / 40), 30 * std::sin(4 * pi * i / 40));
  EXPECT_EQ(inflections(test::uniformCurve(5, eight), 1e-4, true).size(), 2u);
  EXPECT_TRUE(inflections(test::circle(5, {0, 0}), 1e-6, true).empty());
}

TEST(CurvatureJump, IsTheDifferenceAtAJointOverTheLargestCurvature) {
  // Two quadratic pieces that meet at (1, 0) along the x axis: curvature at the joint is half the height over the
  // square of the edge, 0.5 on one side and 1 on the other; at the ends of the first 0.5 / (edge ratio 1) as well.
  const auto curve = NurbsCurve::make(2, {0, 0, 0, 1, 1, 2, 2, 2}, {{-1, 1}, {0, 0}, {1, 0}, {2, 0}, {3, 2}});
  ASSERT_TRUE(curve);
  double largest = 0.0, before = 0.0, after = 0.0;
  for (const double u : {0.0, 1.0 - 1e-9, 1.0, 2.0 - 1e-9}) {
    const double kappa = curvature(*curve, u).value();
    largest = std::max(largest, std::abs(kappa));
    if (u == 1.0) after = kappa;
    if (u > 0.5 && u < 1.0) before = kappa;
  }
  ASSERT_GT(std::abs(after - before), 0.1);
  EXPECT_NEAR(largestCurvatureJump(*curve, false), std::abs(after - before) / largest, 1e-6);
  EXPECT_LT(largestCurvatureJump(ellipse(3.0, 2.0, 40, 0.3), false), 1e-9);
  const NurbsCurve open = test::parabola(2.0, 1.0);
  EXPECT_EQ(largestCurvatureJump(open, false), 0.0);
}

}  // namespace
}  // namespace batten
