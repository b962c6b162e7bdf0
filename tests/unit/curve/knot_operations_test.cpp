// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/knot_operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/curve/curvature.h"
#include "tests/unit/curve/curve_samples.h"

namespace batten {
namespace {

void expectSameShape(const NurbsCurve& a, const NurbsCurve& b, const std::string& what) {
  EXPECT_EQ(a.start(), b.start()) << what;
  EXPECT_EQ(a.end(), b.end()) << what;
  for (const double u : test::parametersOf(a)) {
    ASSERT_LT((a.point(u) - b.point(u)).norm(), 1e-11 * extent(a)) << what << " at " << u;
  }
}

class KnotOperations : public testing::TestWithParam<int> {
 protected:
  NurbsCurve next() {
    ++count_;
    return test::randomCurve(random_, GetParam(), count_ % 2 == 0, count_ % 3 == 0);
  }
  double inside(const NurbsCurve& c) {
    return c.start() + (c.end() - c.start()) * std::uniform_real_distribution<double>(0.02, 0.98)(random_);
  }
  std::mt19937 random_{11};
  int count_ = 0;
};

TEST_P(KnotOperations, InsertionLeavesTheShape) {
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = next();
    const double u = inside(curve);
    const int times = 1 + trial % curve.degree();
    const auto finer = insertKnot(curve, u, times);
    ASSERT_TRUE(finer) << finer.error().message;
    EXPECT_EQ(finer->controlPointCount(), curve.controlPointCount() + times);
    expectSameShape(curve, *finer, "insert");
    EXPECT_FALSE(insertKnot(curve, u, curve.degree() + 1));
    EXPECT_FALSE(insertKnot(curve, curve.end() + 1.0, 1));
  }
}

TEST_P(KnotOperations, AKnotThatWasPutInIsTakenOutAgain) {
  for (int trial = 0; trial < 20; ++trial) {
    const auto curve = test::randomCurve(random_, GetParam(), true, false);
    const int times = 1 + trial % curve.degree();
    const double u = inside(curve);
    const auto finer = insertKnot(curve, u, times);
    ASSERT_TRUE(finer) << finer.error().message;
    std::vector<double> knots(finer->knots().begin(), finer->knots().end());
    std::vector<Vec2> points(finer->controlPoints().begin(), finer->controlPoints().end());
    const int last = static_cast<int>(std::upper_bound(knots.begin(), knots.end(), u) - knots.begin()) - 1;
    for (int k = 0; k < times; ++k) removeExactKnot(curve.degree(), knots, points, {last - k, times - k});
    ASSERT_EQ(points.size(), curve.controlPoints().size());
    EXPECT_TRUE(std::equal(knots.begin(), knots.end(), curve.knots().begin(), curve.knots().end()));
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_LT((points[i] - curve.controlPoints()[i]).norm(), 1e-7 * extent(curve)) << "point " << i;
  }
}

TEST_P(KnotOperations, ClampedLeavesTheShape) {
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = next();
    const auto result = clamped(curve);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->knots().front(), result->start());
    EXPECT_EQ(result->knots().back(), result->end());
    EXPECT_LT((result->controlPoints().front() - curve.point(curve.start())).norm(), 1e-11 * extent(curve));
    EXPECT_LT((result->controlPoints().back() - curve.point(curve.end())).norm(), 1e-11 * extent(curve));
    expectSameShape(curve, *result, "clamp");
    EXPECT_EQ(*clamped(*result), *result);
  }
}

TEST_P(KnotOperations, AllCutsAtOnceGiveThePartsBetweenThem) {
  for (int trial = 0; trial < 20; ++trial) {
    const auto curve = next();
    std::vector<double> places = {inside(curve), inside(curve), inside(curve), curve.breaks()[1]};
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    const auto parts = splitAtAll(curve, places);
    ASSERT_TRUE(parts) << parts.error().message;
    ASSERT_EQ(parts->size(), places.size() + 1);
    for (std::size_t i = 0; i < parts->size(); ++i) {
      const NurbsCurve& part = (*parts)[i];
      if (i > 0) {
        EXPECT_EQ(part.start(), places[i - 1]);
      }
      if (i < places.size()) {
        EXPECT_EQ(part.end(), places[i]);
      }
      for (const double f : {0.0, 0.3, 0.9}) {
        const double u = part.start() + f * (part.end() - part.start());
        ASSERT_LT((part.point(u) - curve.point(u)).norm(), 1e-11 * extent(curve));
      }
    }
    EXPECT_EQ(splitAtAll(curve, {})->size(), 1u);
    EXPECT_FALSE(splitAtAll(curve, std::vector{curve.start()}));
  }
}

TEST_P(KnotOperations, SplitAndJoinLeaveTheShape) {
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = next();
    const double u = trial % 4 == 0 ? curve.breaks()[1] : inside(curve);
    const auto halves = split(curve, u);
    ASSERT_TRUE(halves);
    EXPECT_EQ(halves->left.end(), u);
    EXPECT_EQ(halves->right.start(), u);
    for (const double v : test::parametersOf(curve)) {
      const auto& half = v < u ? halves->left : halves->right;
      ASSERT_LT((half.point(v) - curve.point(v)).norm(), 1e-11 * extent(curve));
    }
    const std::vector<NurbsCurve> both = {halves->left, halves->right};
    const auto joined = joinAtCorners(both, 1e-9 * extent(curve));
    ASSERT_TRUE(joined) << joined.error().message;
    EXPECT_EQ(joined->controlPointCount(), halves->left.controlPointCount() + halves->right.controlPointCount() - 1);
    EXPECT_NEAR(joined->end(), curve.end(), 1e-12);
    for (const double v : test::parametersOf(curve)) {
      ASSERT_LT((joined->point(v) - curve.point(v)).norm(), 1e-9 * extent(curve));
    }
    EXPECT_FALSE(split(curve, curve.start()));
    EXPECT_FALSE(split(curve, curve.end() + 1));
  }
}

TEST_P(KnotOperations, ElevationLeavesTheShape) {
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = next();
    for (int degree = curve.degree(); degree <= 7; ++degree) {
      const auto higher = elevated(curve, degree);
      ASSERT_TRUE(higher) << higher.error().message;
      EXPECT_EQ(higher->degree(), degree);
      expectSameShape(curve, *higher, "elevate");
    }
    EXPECT_FALSE(elevated(curve, 8));
    EXPECT_FALSE(elevated(curve, curve.degree() - 1));
  }
}

TEST_P(KnotOperations, ReversedAndReparametrized) {
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = next();
    const auto back = reversed(curve);
    const auto moved = reparametrized(curve, 10.0, 25.0);
    ASSERT_TRUE(moved);
    for (int i = 0; i <= 50; ++i) {
      const double f = i / 50.0, u = curve.start() + f * (curve.end() - curve.start());
      ASSERT_LT((back.point(curve.start() + curve.end() - u) - curve.point(u)).norm(), 1e-10 * extent(curve));
      ASSERT_LT((moved->point(10.0 + 15.0 * f) - curve.point(u)).norm(), 1e-10 * extent(curve));
    }
    EXPECT_FALSE(reparametrized(curve, 1.0, 1.0));
  }
}

TEST_P(KnotOperations, BezierPiecesAreTheCurve) {
  for (int trial = 0; trial < 40; ++trial) {
    const auto curve = next();
    const auto pieces = bezierPieces(curve);
    if (curve.isRational()) {
      EXPECT_FALSE(pieces);
      continue;
    }
    ASSERT_TRUE(pieces);
    EXPECT_EQ(pieces->size() + 1, curve.breaks().size());
    for (const auto& piece : *pieces) {
      for (const double f : {0.0, 0.2, 0.5, 0.9}) {
        std::vector<Vec2> q = piece.controlPoints;
        while (q.size() > 1) {
          for (std::size_t i = 0; i + 1 < q.size(); ++i) q[i] = (1 - f) * q[i] + f * q[i + 1];
          q.pop_back();
        }
        const Vec2 expected = curve.point(piece.start + f * (piece.end - piece.start));
        ASSERT_LT((q[0] - expected).norm(), 1e-10 * extent(curve));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, KnotOperations, testing::Values(1, 2, 3, 4, 5, 6, 7));

TEST(JoinAtCorners, KeepsTheCornerWithMultiplicityDegree) {
  const auto a = NurbsCurve::make(2, {0, 0, 0, 1, 1, 1}, {{0, 0}, {1, 0}, {2, 0}}).value();
  const auto b = NurbsCurve::make(2, {5, 5, 5, 7, 7, 7}, {{2, 0}, {2, 1}, {2, 2}}).value();
  const std::vector<NurbsCurve> pieces = {a, b};
  const auto joined = joinAtCorners(pieces, 1e-9).value();
  EXPECT_EQ(std::vector<double>(joined.knots().begin(), joined.knots().end()),
            (std::vector<double>{0, 0, 0, 1, 1, 3, 3, 3}));
  EXPECT_EQ(joined.point(1.0), Vec2(2, 0));
  const std::vector<NurbsCurve> apart = {a, b.mapped(Eigen::Matrix2d::Identity(), {0.5, 0})};
  EXPECT_FALSE(joinAtCorners(apart, 0.1));
  EXPECT_EQ(joinAtCorners(apart, 1.0).value().point(1.0), Vec2(2.25, 0));
  EXPECT_FALSE(joinAtCorners({}, 1.0));
}

TEST(InsertKnot, KeepsUntouchedControlPointsBitForBit) {
  std::mt19937 random(12);
  std::vector<Vec2> points;
  for (int i = 0; i < 30; ++i)
    points.emplace_back(i + 0.1 * static_cast<double>(random() % 7), static_cast<double>(random() % 10));
  const auto curve = clamped(test::uniformCurve(5, points)).value();
  const auto finer = insertKnot(curve, 20.3, 1).value();
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(finer.controlPoints()[i], curve.controlPoints()[i]);
  for (std::size_t i = 1; i < 3; ++i) EXPECT_EQ(finer.controlPoints()[31 - i], curve.controlPoints()[30 - i]);
}

}  // namespace
}  // namespace batten
