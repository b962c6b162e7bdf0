// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/nurbs/quintic_nurbs.h"

#include <gtest/gtest.h>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "tests/support/known_answers.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

using std::numbers::pi;

std::vector<Station> stationsFrom(const nlohmann::json& answer) {
  std::vector<Station> stations;
  const auto points = test::toPoints(answer.at("midpoints")), directions = test::toPoints(answer.at("unit_directions"));
  for (std::size_t i = 0; i < points.size(); ++i) stations.push_back({points[i], directions[i], points[i], points[i]});
  return stations;
}

TEST(DerivativeMagnitudes, MatchTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "02_fit.json");
  for (const auto& item : answer.at("cases")) {
    const auto stations = stationsFrom(item);
    const auto corrected = derivativeMagnitudes(stations, false, 1.0, false);
    const auto third = derivativeMagnitudes(stations, false, 1.0, true);
    for (std::size_t i = 0; i < stations.size(); ++i) {
      EXPECT_NEAR(corrected[i], item.at("arc_corrected_magnitude").at(i).get<double>(), 1e-9);
      EXPECT_NEAR(third[i], item.at("adjacent_mean_distance").at(i).get<double>() / 3.0, 1e-9);
    }
  }
}

TEST(SolveQuintic, MatchesTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "02_fit.json");
  for (const auto& item : answer.at("cases")) {
    const auto points = test::toPoints(item.at("midpoints"));
    for (const char* name : {"paper_f_one_third", "f1_chord", "f1_arc_corrected"}) {
      const auto& part = item.at(name);
      const auto derivatives = test::toPoints(part.at("derivative_vectors"));
      const auto result = solveQuintic(points, derivatives, false, GradientUse::All);
      ASSERT_TRUE(result);
      // Underdetermined: the answer lists the solution of smallest integral of |R'''|^2 under its own name.
      const bool few = points.size() < 4;
      const auto expected = test::toPoints(part.at(few ? "control_points_min_energy_d3" : "control_points"));
      ASSERT_EQ(result->controlPoints.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_LT((result->controlPoints[i] - expected[i]).norm(), few ? 1e-6 : 1e-7) << name << " " << points.size();
      }
      EXPECT_NEAR(result->residualRmsPosition, part.at("residual_rms_position").get<double>(), 1e-7);
      EXPECT_NEAR(result->residualRmsDerivative, part.at("residual_rms_derivative").get<double>(), 1e-7);
    }
  }
}

TEST(SolveQuintic, FewStationsFulfilTheEquationsWhereverTheOriginIs) {
  for (const std::size_t m : {2u, 3u}) {
    std::vector<Vec2> points, derivatives, moved;
    for (std::size_t i = 0; i < m; ++i) {
      points.push_back(test::ellipsePoint(0.4 * static_cast<double>(i)));
      derivatives.push_back(Vec2(-60 + 9.0 * static_cast<double>(i), 50));
      moved.push_back(points.back() + Vec2(1000, -700));
    }
    const auto a = solveQuintic(points, derivatives, false, GradientUse::All);
    const auto b = solveQuintic(moved, derivatives, false, GradientUse::All);
    ASSERT_TRUE(a && b);
    EXPECT_LT(a->residualRmsPosition, 1e-9);
    EXPECT_LT(a->residualRmsDerivative, 1e-9);
    for (std::size_t i = 0; i < a->controlPoints.size(); ++i) {
      EXPECT_LT((b->controlPoints[i] - a->controlPoints[i] - Vec2(1000, -700)).norm(), 1e-7);
    }
  }
}

TEST(SolveQuintic, NaturalEndsAndFourGradientsHoldTheirEquations) {
  for (const int m : {4, 5, 9, 40}) {
    std::vector<Vec2> points, derivatives;
    for (int i = 0; i < m; ++i) {
      const double t = 1.5 * i / (m - 1);
      points.push_back(test::ellipsePoint(t));
      derivatives.push_back(Vec2(-300 * std::sin(t), 150 * std::cos(t)) * (1.5 / (m - 1)));
    }
    for (const GradientUse use : {GradientUse::NaturalEnds, GradientUse::Four}) {
      const auto result = solveQuintic(points, derivatives, false, use);
      ASSERT_TRUE(result);
      EXPECT_LT(result->residualRmsPosition, 1e-9);
      std::vector<double> knots;
      for (int i = -5; i < m + 5; ++i) knots.push_back(i);
      const auto curve = NurbsCurve::make(5, knots, result->controlPoints).value();
      for (const double u : {0.0, m - 1.0}) {
        const auto d = curve.derivatives(u, 4);
        if (use == GradientUse::NaturalEnds) {
          EXPECT_LT(d[2].norm() + d[4].norm(), 1e-8);
        } else {
          EXPECT_LT((d[1] - derivatives[u == 0.0 ? 0 : m - 1]).norm(), 1e-9);
        }
      }
    }
  }
}

TEST(SolveQuintic, ManyStationsAndClosed) {
  const int m = 2000;
  std::vector<Vec2> points, derivatives;
  for (int i = 0; i < m; ++i) {
    const double t = 2 * pi * i / m;
    points.push_back(test::ellipsePoint(t));
    derivatives.push_back(Vec2(-300 * std::sin(t), 150 * std::cos(t)) * (2 * pi / m));
  }
  for (const bool closed : {false, true}) {
    const auto result = solveQuintic(points, derivatives, closed, GradientUse::All);
    ASSERT_TRUE(result);
    EXPECT_EQ(static_cast<int>(result->controlPoints.size()), closed ? m : m + 4);
    EXPECT_LT(result->residualRmsPosition, 1e-6);
    EXPECT_LT(result->residualRmsDerivative, 1e-6);
  }
  EXPECT_FALSE(solveQuintic(std::span(points).first(1), std::span(derivatives).first(1), false, GradientUse::All));
  EXPECT_FALSE(solveQuintic(std::span(points).first(5), std::span(derivatives).first(5), true, GradientUse::All));
}

struct Measured {
  double rms = 0.0;
  int extrema = 0;
};
Measured measure(const ConstructPiece& piece, const ConstructParams& params) {
  const auto made = constructQuinticNurbs(piece, params, {});
  EXPECT_TRUE(made);
  if (!made) return {};
  return {deviation(made->curve, positionsOf(piece.points), true).rms,
          static_cast<int>(curvatureExtrema(made->curve, 5e-3 / extent(made->curve), piece.closed).size())};
}

TEST(ConstructQuinticNurbs, EllipseQuarterIsTrueAndTheOneThirdRuleIsNot) {
  // Equal steps of the angle as in the known answer, so that the numbers of the comparison hold.
  auto piece = test::pieceOf(test::ellipsePoint, 0.1, 1.45, 8, false);
  ConstructParams params;
  const auto ours = measure(piece, params);
  EXPECT_LT(ours.rms, 0.01);
  EXPECT_EQ(ours.extrema, 0);
  params.magnitudeAsInPaper = true;
  const auto paper = measure(piece, params);
  EXPECT_GT(paper.rms, 3.0);
  EXPECT_GE(paper.extrema, 5);
}

TEST(ConstructQuinticNurbs, UnevenStationsAreNoHarm) {
  auto piece = test::pieceOf(test::ellipsePoint, 0.1, 2.4, 16, false);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  piece.stations = test::stationsOf(test::ellipsePoint, 0.1, 2.4, 16, false,
                                    [&](int k) { return k == 0 || k == 15 ? 0.0 : shift(random); });
  const auto measured = measure(piece, {});
  EXPECT_LT(measured.rms, 0.01);
  EXPECT_EQ(measured.extrema, 1);  // The end of the minor axis, at pi / 2.
}

TEST(ConstructQuinticNurbs, OpenEndsAreExact) {
  auto piece = test::pieceOf(test::ellipsePoint, 0.2, 2.0, 12, false);
  piece.startIsCorner = piece.endIsCorner = true;
  piece.points.front().at += Vec2(0.3, -0.2);
  const auto made = constructQuinticNurbs(piece, {}, {}).value();
  EXPECT_EQ(made.curve.point(made.curve.start()), piece.points.front().at);
  EXPECT_EQ(made.curve.point(made.curve.end()), piece.points.back().at);
  EXPECT_EQ(made.curve.degree(), 5);
  const double length = ArcLength(made.curve).total();
  EXPECT_NEAR(made.curve.end() - made.curve.start(), length, 0.01 * length);
}

TEST(ConstructQuinticNurbs, StationsInsideThePieceAreExtendedToItsEnds) {
  auto piece = test::pieceOf(test::ellipsePoint, 0.2, 2.0, 12, false);
  const auto groups = test::stationsOf(test::ellipsePoint, 0.28, 1.9, 11, false);
  piece.stations = groups;
  const auto made = constructQuinticNurbs(piece, {}, {}).value();
  EXPECT_EQ(made.curve.point(made.curve.start()), piece.points.front().at);
  EXPECT_EQ(made.curve.point(made.curve.end()), piece.points.back().at);
  EXPECT_LT(deviation(made.curve, positionsOf(piece.points), true).max, 0.5);
}

TEST(ConstructQuinticNurbs, ClosedCurvesMeetWithAllDerivatives) {
  for (const int m : {6, 13, 40, 60}) {
    const auto piece = test::pieceOf(test::ellipsePoint, 0.0, 2 * pi, m, true);
    const auto made = constructQuinticNurbs(piece, {}, {}).value();
    const auto a = made.curve.derivatives(made.curve.start(), 4), b = made.curve.derivatives(made.curve.end(), 4);
    for (std::size_t d = 0; d < 5; ++d) EXPECT_LT((a[d] - b[d]).norm(), 1e-8 * (1.0 + a[d].norm())) << d;
    if (m >= 40) {
      EXPECT_LT(deviation(made.curve, positionsOf(piece.points), true).rms, 0.02);
    }
    if (m >= 60) {
      EXPECT_EQ(curvatureExtrema(made.curve, 5e-3 / extent(made.curve), true).size(), 4u);
    }
  }
}

TEST(ConstructQuinticNurbs, GradientsNotUsedMatterLittle) {
  const auto piece = test::pieceOf(test::ellipsePoint, 0.1, 1.45, 8, false);
  ConstructParams params;
  params.gradients = GradientUse::Four;
  EXPECT_LT(measure(piece, params).rms, 0.02);
  params.gradients = GradientUse::NaturalEnds;
  EXPECT_LT(measure(piece, params).rms, 3.0);
}

TEST(ConstructQuinticNurbs, AnythingGivesAFiniteCurveOrAnError) {
  std::mt19937 random(9);
  std::normal_distribution<double> where(0.0, 40.0);
  for (int trial = 0; trial < 300; ++trial) {
    ConstructPiece piece;
    piece.closed = trial % 3 == 0;
    piece.startIsCorner = trial % 2 == 0;
    const auto count = random() % 9;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 p(where(random), where(random));
      piece.points.push_back({p});
      if (random() % 4 != 0) piece.stations.push_back({p, Vec2(where(random), where(random)), p, p});
      if (random() % 5 == 0) piece.stations.push_back({p, Vec2::Zero(), p, p});
    }
    ConstructParams params;
    params.gradients = static_cast<GradientUse>(random() % 3);
    params.magnitudeAsInPaper = random() % 4 == 0;
    const auto made = constructQuinticNurbs(piece, params, {});
    if (!made) {
      EXPECT_EQ(made.error().code, ErrorCode::Numerical);
      continue;
    }
    for (const Vec2& p : made->curve.controlPoints()) ASSERT_TRUE(p.allFinite());
    EXPECT_EQ(made->curve.degree(), 5);
  }
}

}  // namespace
}  // namespace batten
