// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/nurbs_curve.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/known_answers.h"
#include "tests/unit/curve/curve_samples.h"

namespace batten {
namespace {

TEST(Basis, UniformQuinticMatchesTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "01_basis.json");
  std::vector<double> knots;
  for (int i = -5; i <= 7; ++i) knots.push_back(i);
  for (int order = 0; order <= 4; ++order) {
    const auto& rows = answer.at("derivative").at(std::to_string(order));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double u = answer.at("u").at(i);
      const BasisRow row = basis(5, knots, 7, u, 4);
      // At u = 1 the next span has begun; its five functions are those of the row shifted by one.
      const std::size_t shift = u == 1.0 ? 1 : 0;
      for (std::size_t j = 0; j + shift < 6; ++j) {
        EXPECT_NEAR(row.values[order][j], rows.at(i).at(j + shift).get<double>(), 1e-13);
      }
    }
  }
}

TEST(Basis, SumsToOneAndItsDerivativesToZero) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const auto curve = test::randomCurve(random, 1 + trial % 7, trial % 2 == 0, false);
    for (const double u : test::parametersOf(curve)) {
      const BasisRow row = basis(curve.degree(), curve.knots(), curve.controlPointCount(), u, 4);
      for (std::size_t d = 0; d < 5; ++d) {
        double sum = 0.0, size = 1.0;
        for (const double v : row.values[d]) {
          sum += v;
          size += std::abs(v);
        }
        EXPECT_NEAR(sum, d == 0 ? 1.0 : 0.0, 1e-12 * size);
      }
      EXPECT_GE(row.first, 0);
      EXPECT_LE(row.first + curve.degree(), curve.controlPointCount() - 1);
    }
  }
}

TEST(NurbsCurve, PointIsThePolarFormOfDeBoor) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 60; ++trial) {
    const auto curve = test::randomCurve(random, 1 + trial % 7, trial % 2 == 0, false);
    const int p = curve.degree();
    for (const double u : test::parametersOf(curve)) {
      int span = p;
      while (span + 1 < curve.controlPointCount() && curve.knots()[span + 1] <= u) ++span;
      std::vector<Vec2> d;
      for (int j = 0; j <= p; ++j) d.push_back(curve.controlPoints()[span - p + j]);
      for (int r = 1; r <= p; ++r) {
        for (int j = p; j >= r; --j) {
          const double low = curve.knots()[span - p + j];
          const double high = curve.knots()[span + j + 1 - r];
          const double a = (u - low) / (high - low);
          d[j] = (1 - a) * d[j - 1] + a * d[j];
        }
      }
      EXPECT_LT((curve.point(u) - d.back()).norm(), 1e-9);
      EXPECT_LT((curve.derivatives(u, 0)[0] - d.back()).norm(), 1e-9);
    }
  }
}

TEST(NurbsCurve, DerivativesAreFiniteDifferences) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 120; ++trial) {
    const auto curve = test::randomCurve(random, 1 + trial % 7, trial % 2 == 0, trial % 3 == 0);
    const auto breaks = curve.breaks();
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double h = 1e-4 * (breaks[i + 1] - breaks[i]);
      for (const double f : {0.1, 0.37, 0.8}) {
        const double u = breaks[i] + f * (breaks[i + 1] - breaks[i]);
        const auto d = curve.derivatives(u, 4), before = curve.derivatives(u - h, 4),
                   after = curve.derivatives(u + h, 4);
        for (std::size_t k = 0; k < 4; ++k) {
          const Vec2 difference = (after[k] - before[k]) / (2 * h);
          double scale = 1.0;
          for (const auto& v : d) scale = std::max(scale, v.norm());
          EXPECT_LT((difference - d[k + 1]).norm(), 1e-4 * scale) << "degree " << curve.degree() << " order " << k + 1;
        }
      }
    }
  }
}

TEST(NurbsCurve, BordersOfSpans) {
  const auto curve = NurbsCurve::make(1, {0, 0, 1, 2, 2}, {{0, 0}, {1, 0}, {1, 3}}).value();
  EXPECT_EQ(curve.derivatives(1.0, 1)[1], Vec2(0, 3));  // Right limit at an inner knot.
  EXPECT_EQ(curve.derivatives(2.0, 1)[1], Vec2(0, 3));  // Left limit at the end.
  EXPECT_EQ(curve.point(-5.0), Vec2(0, 0));
  EXPECT_EQ(curve.point(9.0), Vec2(1, 3));
  EXPECT_EQ(curve.breaks(), (std::vector<double>{0, 1, 2}));
}

TEST(NurbsCurve, CircleIsACircle) {
  const auto circle = test::circle(7.0, {100, 30});
  for (const double u : test::parametersOf(circle)) {
    EXPECT_NEAR((circle.point(u) - Vec2(100, 30)).norm(), 7.0, 1e-12);
    EXPECT_NEAR(circle.derivatives(u, 1)[1].dot(circle.point(u) - Vec2(100, 30)), 0.0, 1e-10);
  }
}

TEST(NurbsCurve, MapsExactlyAndCompares) {
  std::mt19937 random(4);
  const auto curve = test::randomCurve(random, 5, true, true);
  Eigen::Matrix2d m;
  m << 2, 1, -1, 3;
  const auto mapped = curve.mapped(m, {5, -4});
  for (const double u : test::parametersOf(curve)) {
    EXPECT_LT((mapped.point(u) - (m * curve.point(u) + Vec2(5, -4))).norm(), 1e-10);
  }
  EXPECT_FALSE(mapped == curve);
  EXPECT_TRUE(mapped == NurbsCurve(mapped));
  EXPECT_TRUE(NurbsCurve() == NurbsCurve());
  EXPECT_FALSE(NurbsCurve() == curve);
}

TEST(NurbsCurve, RefusesWhatIsNoCurve) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, points));
  EXPECT_TRUE(NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, points, {1, 1, 1}).value().weights().empty());
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 0, 1, 1}, points));
  EXPECT_FALSE(NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1}, points));
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 1, 0, 1, 1}, points));
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 0, 0, 0, 0}, points));
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 0, nan, 1, 1}, points));
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{0, 0}, {nan, 0}, {2, 1}}));
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, points, {1, 0, 1}));
  EXPECT_FALSE(NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, points, {1, 1}));
  EXPECT_FALSE(NurbsCurve::make(1, {0, 0, 1, 1, 1, 2, 2}, {{0, 0}, {1, 0}, {2, 1}, {3, 0}, {4, 0}}));
  EXPECT_FALSE(NurbsCurve::make(0, {0, 1}, {{0, 0}}));
  EXPECT_FALSE(NurbsCurve::make(8, std::vector<double>(18, 0.0), std::vector<Vec2>(9, Vec2(0, 0))));
}

}  // namespace
}  // namespace batten
