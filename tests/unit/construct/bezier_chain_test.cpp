// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/bezier/bezier_chain.h"

#include <gtest/gtest.h>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "tests/unit/construct/any_pieces.h"
#include "tests/unit/construct/roof_line.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

using std::numbers::pi;

void disturb(std::vector<Station>& stations, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (Station& s : stations) {
    s.point += noise * normal(random) * leftNormal(s.direction);
    s.direction = (s.direction + 0.02 * noise * normal(random) * leftNormal(s.direction)).normalized();
  }
}

double variation(const NurbsCurve& curve) {
  double sum = 0.0;
  const auto samples = sampleByArcLength(curve, 2001);
  for (std::size_t i = 1; i < samples.size(); ++i) sum += std::abs(samples[i].kappa - samples[i - 1].kappa);
  return sum;
}

TEST(BezierPath, PassesTheStationsInTheirDirections) {
  const auto stations = test::stationsOf(test::roofLine, 0, 900, 24, false);
  const auto path = bezierPath(stations, false);
  ASSERT_EQ(path.size(), 23u);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i][0], stations[i].point);
    EXPECT_EQ(path[i][5], stations[i + 1].point);
    EXPECT_NEAR(cross((path[i][1] - path[i][0]).normalized(), stations[i].direction), 0.0, 1e-12);
    EXPECT_NEAR(cross((path[i][5] - path[i][4]).normalized(), stations[i + 1].direction), 0.0, 1e-12);
  }
  EXPECT_EQ(bezierPath(stations, true).size(), 24u);
}

TEST(LowPassedCurvature, KeepsCirclesAndClothoidsToTheEnds) {
  // Directions whose angle is quadratic in the arc length: a clothoid, on which a local line has no bias.
  std::vector<Station> stations;
  Vec2 p(0, 0);
  for (int i = 0; i <= 4000; ++i) {
    const double s = 0.1 * i, angle = 0.002 * s + 0.5e-5 * s * s;
    if (i % 100 == 0) stations.push_back({p, Vec2(std::cos(angle), std::sin(angle)), p, p});
    const double middle = 0.002 * (s + 0.05) + 0.5e-5 * (s + 0.05) * (s + 0.05);
    p += 0.1 * Vec2(std::cos(middle), std::sin(middle));
  }
  const std::vector<double> places = {0.0, 50.0, 133.0, 400.0};
  const auto kappa = lowPassedCurvature(stations, false, 15.0, places);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(kappa[i], 0.002 + 1e-5 * places[i], 2e-6);
}

TEST(ConstructBezierChain, HasG2AtEveryJoint) {
  auto piece = test::pieceOf(test::roofLine, 0, 900, 30, false);
  disturb(piece.stations, 0.3, 1);
  const auto made = constructBezierChain(piece, {}, {}).value();
  const auto breaks = made.curve.breaks();
  double largest = 0.0;
  for (const double u : breaks) largest = std::max(largest, std::abs(curvature(made.curve, u).value()));
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const auto right = made.curve.derivatives(breaks[i], 2);
    // The left limit by the polynomial of the span before, run to its end.
    const auto left = [&] {
      const double h = 1e-4 * (breaks[i] - breaks[i - 1]);
      const auto d = made.curve.derivatives(breaks[i] - h, 4);
      return std::array<Vec2, 2>{d[1] + h * d[2] + h * h / 2 * d[3] + h * h * h / 6 * d[4],
                                 d[2] + h * d[3] + h * h / 2 * d[4]};
    }();
    EXPECT_LT((left[0] - right[1]).norm(), 1e-9);
    EXPECT_NEAR(cross(left[0], left[1]), cross(right[1], right[2]), 1e-9 * std::max(1.0, largest));
  }
}

TEST(ConstructBezierChain, IsTrueAndFair) {
  for (const double noise : {0.0, 0.05}) {
    auto open = test::pieceOf(test::roofLine, 0, 900, 24, false);
    disturb(open.stations, noise, 2);
    const auto line = constructBezierChain(open, {}, {}).value();
    EXPECT_LT(deviation(line.curve, positionsOf(open.points), true).max, 1.0);
    EXPECT_EQ(curvatureExtrema(line.curve, 5e-3 / extent(line.curve), false).size(), 5u);
    auto closed = test::pieceOf(test::ellipsePoint, 0, 2 * pi, 30, true);
    disturb(closed.stations, noise, 3);
    const auto around = constructBezierChain(closed, {}, {}).value();
    EXPECT_LT(deviation(around.curve, positionsOf(closed.points), true).max, 1.0);
    EXPECT_EQ(curvatureExtrema(around.curve, 5e-3 / extent(around.curve), true).size(), 4u);
  }
}

TEST(ConstructBezierChain, TamesNoise) {
  auto piece = test::pieceOf(test::roofLine, 0, 900, 60, false);
  const double truth = variation(constructBezierChain(piece, {}, {}).value().curve);
  disturb(piece.stations, 0.3, 4);
  const auto made = constructBezierChain(piece, {}, {}).value();
  EXPECT_LT(variation(made.curve), 1.3 * truth);
  EXPECT_LT(deviation(made.curve, positionsOf(piece.points), true).max, 1.0);
}

TEST(ConstructBezierChain, WithoutLowPassIsThePathOfThePaperWithOneCurvatureAtEveryJoint) {
  auto piece = test::pieceOf(test::roofLine, 0, 900, 30, false);
  disturb(piece.stations, 0.3, 1);
  ConstructParams params;
  params.lowPass = 0.0;
  const auto made = constructBezierChain(piece, params, {}).value();
  const auto pieces = bezierPieces(made.curve).value();
  ASSERT_EQ(pieces.size(), 29u);
  std::optional<double> before;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Quintic q;
    std::copy(pieces[i].controlPoints.begin(), pieces[i].controlPoints.end(), q.begin());
    EXPECT_LT((q[0] - piece.stations[i].point).norm(), 1e-9);
    if (before) {
      EXPECT_NEAR(*startCurvature(q), *before, 1e-9 * std::abs(*before) + 1e-12);
    }
    before = endCurvature(q);
  }
  // A wide low pass is calmer than a narrow one, and both are calmer than none.
  params.lowPass = 0.5;
  const double narrow = variation(constructBezierChain(piece, params, {}).value().curve);
  params.lowPass = 2.0;
  const double wide = variation(constructBezierChain(piece, params, {}).value().curve);
  EXPECT_LT(wide, 1.1 * narrow);
  EXPECT_LT(narrow, variation(made.curve));
}

TEST(ConstructBezierChain, AnythingGivesAFiniteCurveOrAnError) {
  test::expectFiniteOrError(150, [](const ConstructPiece& piece) { return constructBezierChain(piece, {}, {}); });
}

}  // namespace
}  // namespace batten
