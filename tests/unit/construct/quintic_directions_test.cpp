// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/nurbs/quintic_directions.h"

#include <gtest/gtest.h>

#include "core/construct/nurbs/quintic_nurbs.h"
#include "core/curve/closest_point.h"
#include "tests/support/known_answers.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

TEST(SolveQuinticDirections, MatchesTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "02_fit.json");
  int compared = 0;
  for (const auto& item : answer.at("cases")) {
    const auto points = test::toPoints(item.at("midpoints")), directions = test::toPoints(item.at("unit_directions"));
    const auto magnitudes = item.at("arc_corrected_magnitude").get<std::vector<double>>();
    for (const auto& [key, smoothness] : {std::pair{"aniso_wt0.3_mu0", 1e-12}, {"aniso_wt0.3_mu1e-3", 1e-3}}) {
      if (!item.contains(key)) continue;
      const auto made = solveQuinticDirections(points, directions, magnitudes, {0.3, smoothness, false});
      ASSERT_TRUE(made);
      const auto expected = test::toPoints(item.at(key).at("control_points"));
      ASSERT_EQ(made->size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_LT(((*made)[i] - expected[i]).norm(), answer.at("tolerance_aniso").get<double>() * 10)
            << key << " " << i;
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, 6);
}

TEST(SolveQuinticDirections, IsRefusedWithTooLittle) {
  const std::vector<Vec2> three = {{0, 0}, {1, 0}, {2, 0}};
  const std::vector<double> ones = {1, 1, 1};
  EXPECT_FALSE(solveQuinticDirections(three, three, ones, {}));
}

TEST(ConstructQuinticNurbs, DirectionsTakeUnevenStations) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-0.1, 0.1);
  ConstructPiece piece = test::pieceOf(test::ellipsePoint, 0.1, 1.45, 9, false);
  piece.stations = test::stationsOf(test::ellipsePoint, 0.1, 1.45, 9, false,
                                    [&](int k) { return k > 0 && k < 8 ? unit(random) : 0.0; });
  ConstructParams params;
  params.gradients = GradientUse::Directions;
  const auto made = constructQuinticNurbs(piece, params, {});
  ASSERT_TRUE(made);
  EXPECT_LT(deviation(made->curve, positionsOf(piece.points), true).max, 0.5);
  EXPECT_LT((made->curve.point(made->curve.start()) - piece.stations.front().point).norm(), 1e-9);
  EXPECT_LT((made->curve.point(made->curve.end()) - piece.stations.back().point).norm(), 1e-9);
}

}  // namespace
}  // namespace batten
