// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/bezier_quintics.h"

#include <gtest/gtest.h>

#include <random>

#include "core/curve/curvature.h"
#include "tests/support/known_answers.h"

namespace batten {
namespace {

nlohmann::json answer(const char* part) { return test::knownAnswer(BATTEN_TEST_DATA, "10_bezier.json").at(part); }

Quintic toQuintic(const nlohmann::json& list) {
  Quintic q;
  for (std::size_t i = 0; i < 6; ++i) q[i] = test::toVec2(list.at(i));
  return q;
}
void expectNear(const Quintic& a, const Quintic& b) {
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-12) << i;
}
NurbsCurve asCurve(const Quintic& q) {
  return NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {q.begin(), q.end()}).value();
}

TEST(QuinticPieces, ElevationMatchesTheKnownAnswer) {
  const auto known = answer("elevation");
  const auto quadratic = test::toPoints(known.at("quadratic"));
  const Quintic q = elevatedQuadratic(quadratic[0], quadratic[1], quadratic[2]);
  expectNear(q, toQuintic(known.at("quintic")));
  for (std::size_t i = 0; i < known.at("u").size(); ++i) {
    const double u = known.at("u").at(i);
    EXPECT_LT((asCurve(q).point(u) - test::toVec2(known.at("points").at(i))).norm(), 1e-12);
    EXPECT_NEAR(curvature(asCurve(q), u).value(), known.at("kappa_from_quadratic").at(i).get<double>(), 1e-12);
  }
}

TEST(QuinticPieces, ElevatedCubicIsTheCubic) {
  const std::vector<Vec2> c = {{0, 0}, {3, 5}, {9, -2}, {10, 4}};
  const auto cubic = NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, c).value();
  const auto quintic = asCurve(elevatedCubic(c[0], c[1], c[2], c[3]));
  for (int i = 0; i <= 20; ++i) EXPECT_LT((cubic.point(i / 20.0) - quintic.point(i / 20.0)).norm(), 1e-13);
}

TEST(QuinticPieces, AnElevatedLineRunsEvenlyFromEndToEnd) {
  const Vec2 from(0.1, 0.7), to(20.3, -4.9);
  const Quintic q = elevatedLine(from, to);
  EXPECT_EQ(q.front(), from);
  EXPECT_EQ(q.back(), to);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT((q[i] - from - i / 5.0 * (to - from)).norm(), 1e-13);
}

TEST(QuinticPieces, PlacesAndDerivativesAreThoseOfThePolynomial) {
  std::mt19937 random(8);
  std::normal_distribution<double> where(0.0, 10.0);
  Quintic q;
  for (Vec2& p : q) p = {where(random), where(random)};
  // Sums of Bernstein polynomials, of degree 5, 4 and 3.
  const auto sum = [](int n, double t, const auto& value) {
    Vec2 result = Vec2::Zero();
    double binomial = 1.0;
    for (int i = 0; i <= n; binomial *= static_cast<double>(n - i) / (i + 1), ++i) {
      result += binomial * std::pow(t, i) * std::pow(1.0 - t, n - i) * value(i);
    }
    return result;
  };
  for (const double t : {0.0, 0.3, 0.77, 1.0}) {
    const QuinticPoint at = evaluate(q, t);
    EXPECT_LT((at.point - sum(5, t, [&](std::size_t i) { return q[i]; })).norm(), 1e-12);
    const Vec2 first = sum(4, t, [&](std::size_t i) { return Vec2(5.0 * (q[i + 1] - q[i])); });
    const Vec2 second = sum(3, t, [&](std::size_t i) { return Vec2(20.0 * (q[i + 2] - 2.0 * q[i + 1] + q[i])); });
    EXPECT_LT((at.first - first).norm(), 1e-11);
    EXPECT_LT((at.second - second).norm(), 1e-10);
    EXPECT_NEAR(at.curvature(), cross(first, second) / std::pow(first.norm(), 3.0), 1e-10);
  }
}

TEST(QuinticPieces, EndCurvaturesMatchTheKnownAnswer) {
  const auto known = answer("end_curvature");
  const Quintic q = toQuintic(known.at("Q"));
  EXPECT_NEAR(startCurvature(q).value(), known.at("kappa0_eq9").get<double>(), 1e-12);
  EXPECT_NEAR(endCurvature(q).value(), known.at("kappa1_eq10").get<double>(), 1e-12);
  EXPECT_NEAR(startCurvature(q).value(), curvature(asCurve(q), 0.0).value(), 1e-12);
  EXPECT_NEAR(endCurvature(q).value(), curvature(asCurve(q), 1.0).value(), 1e-12);
  const auto set = answer("set_curvature");
  Quintic changed = toQuintic(set.at("Q"));
  setStartCurvature(changed, set.at("k_left"));
  setEndCurvature(changed, set.at("k_right"));
  expectNear(changed, toQuintic(set.at("result")));
  Quintic still;
  still.fill(Vec2(1, 1));
  EXPECT_FALSE(startCurvature(still));
  EXPECT_FALSE(endCurvature(still));
}

TEST(QuinticPieces, JointMatchesTheKnownAnswer) {
  const auto known = answer("joint");
  Quintic a = toQuintic(known.at("A")), b = toQuintic(known.at("B"));
  const auto mean = equaliseJoint(a, b);
  EXPECT_NEAR(mean.value(), known.at("mean").get<double>(), 1e-12);
  expectNear(a, toQuintic(known.at("A_new")));
  expectNear(b, toQuintic(known.at("B_new")));
}

TEST(QuinticPieces, VertexAndItsLimits) {
  const auto known = answer("intersection");
  const auto v = [&](const char* key) { return test::toVec2(known.at(key)); };
  const auto vertex = tangentVertex(v("P"), v("d"), v("Q"), v("e"));
  ASSERT_TRUE(vertex);
  EXPECT_LT((*vertex - v("vertex")).norm(), 1e-12);
  EXPECT_FALSE(tangentVertex({0, 0}, {1, 0}, {10, 0}, {1, 0}));                                      // Parallel.
  EXPECT_FALSE(tangentVertex({0, 0}, {1, 0}, {10, 1}, Vec2(1, 0.004).normalized()));                 // Hardly an angle.
  EXPECT_FALSE(tangentVertex({0, 0}, Vec2(1, 1).normalized(), {10, 0}, Vec2(1, 1.2).normalized()));  // Inflection.
  EXPECT_FALSE(tangentVertex({0, 0}, {1, 0}, {10, 0.3}, {0, 1}));  // Too near to one end.
  EXPECT_FALSE(tangentVertex({3, 3}, {1, 0}, {3, 3}, {0, 1}));
}

TEST(QuinticPieces, HermiteMatchesTheKnownAnswer) {
  const auto known = answer("G2_hermite");
  const Joint from{test::toVec2(known.at("P0")), test::toVec2(known.at("T0")), known.at("k0")};
  const Joint to{test::toVec2(known.at("P1")), test::toVec2(known.at("T1")), known.at("k1")};
  expectNear(quinticHermite(from, to, known.at("L0")), toQuintic(known.at("Q")));
}

TEST(HermiteChain, IsItsPiecesAndC2) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Joint> joints;
  std::vector<double> lengths;
  for (int i = 0; i < 9; ++i) {
    const double angle = unit(random);
    joints.push_back({Vec2(20.0 * i, 5 * unit(random)), Vec2(std::cos(angle), std::sin(angle)), 0.05 * unit(random)});
    if (i > 0) lengths.push_back(15 + 8 * unit(random));
  }
  const auto chain = hermiteChain(joints, lengths).value();
  double start = 0.0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto piece = asCurve(quinticHermite(joints[i], joints[i + 1], lengths[i]));
    for (const double t : {0.0, 0.2, 0.5, 0.9}) {
      EXPECT_LT((chain.point(start + t * lengths[i]) - piece.point(t)).norm(), 1e-11);
    }
    EXPECT_LT((chain.derivatives(start, 1)[1] - joints[i].tangent).norm(), 1e-12);
    EXPECT_NEAR(curvature(chain, start).value(), joints[i].kappa, 1e-12);
    EXPECT_NEAR(curvature(chain, start * (1 - 1e-13)).value(), joints[i].kappa, 1e-9);
    start += lengths[i];
  }
  EXPECT_FALSE(hermiteChain(std::span(joints).first(1), {}));
}

}  // namespace
}  // namespace batten
