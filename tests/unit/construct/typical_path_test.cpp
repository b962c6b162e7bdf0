// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_path.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "core/construct/typical/typical_growing.h"
#include "core/construct/typical/typical_path_fit.h"
#include "core/construct/typical/typical_tiling.h"
#include "core/curve/knot_operations.h"
#include "core/curve/nurbs_curve.h"
#include "tests/support/known_answers.h"
#include "tests/unit/construct/stations_of.h"

namespace batten {
namespace {

PathElement typicalElement(double turn, double logRatio, Trend trend) {
  PathElement element;
  element.logTurn = std::log(turn);
  element.trend = trend;
  element.setLogRatio(logRatio);
  return element;
}

/// Typical, typical, Hermite, turning left.
TypicalPath somePath() {
  TypicalPath path;
  path.elements = {typicalElement(0.3, -0.1, Trend::Rising), typicalElement(0.25, 0.1, Trend::Falling), {}};
  path.elements[2].typical = false;
  path.states.resize(4);
  path.states[0] = {{0, 0}, 0.1, 0.005};
  EXPECT_TRUE(path.update());
  path.states[3] = {path.states[2].point + Vec2(20, 90), 1.4, 0.001};
  EXPECT_TRUE(path.update());
  return path;
}

TEST(TypicalPath, SharesPlaceDirectionAndCurvatureAtEveryJoint) {
  const TypicalPath path = somePath();
  for (std::size_t e = 0; e + 1 < path.elements.size(); ++e) {
    const Quintic one = path.quintic(e), next = path.quintic(e + 1);
    EXPECT_LT((one[5] - next[0]).norm(), 1e-10);
    EXPECT_NEAR(cross((one[5] - one[4]).normalized(), (next[1] - next[0]).normalized()), 0.0, 1e-12);
    EXPECT_NEAR(*endCurvature(one), *startCurvature(next), 1e-12);
  }
}

TEST(TypicalPath, TrendsKeepTheCurvatureMonotoneWhateverTheUnknowns) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    PathElement element =
        typicalElement(0.4 + 0.39 * unit(random), 0.0, trial % 2 == 0 ? Trend::Rising : Trend::Falling);
    element.shape = 3.0 * unit(random);
    TypicalPath path;
    path.elements = {element};
    path.states.resize(2);
    path.states[0].kappa = 0.01;
    if (!path.update()) continue;
    EXPECT_TRUE(path.typical(0).isMonotone());
    EXPECT_EQ(path.states[1].kappa > 0.01, element.trend == Trend::Rising);
  }
}

TEST(FitPath, APathOfWhichNothingCanMoveIsNoFit) {
  TypicalPath path;
  path.closed = true;
  path.elements.resize(1);
  path.elements[0].typical = false;
  path.states = {{{0, 0}, 0.0, 0.01}, {{0, 0}, 0.0, 0.01}};
  PathData data;
  for (int i = 0; i < 40; ++i) data.points.emplace_back(20.0 * std::sin(0.16 * i), 20.0 - 20.0 * std::cos(0.16 * i));
  const auto fitted = fitPath(path, data, 10, {});
  EXPECT_TRUE(!fitted || std::isfinite(fitted->fit.rms));
}

// Where no typical curve has to give way, the pieces are the line that they are laid along: a fit to the noise of the
// points would only take time.
TEST(FitPath, HermitePiecesHeldToTheirLineStayAsTheyAre) {
  TypicalPath path;
  PathData data;
  data.hold = 0.01;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.3);
  constexpr double kRadius = 200.0;
  const auto at = [=](double angle) -> Vec2 { return kRadius * Vec2(std::sin(angle), 1.0 - std::cos(angle)); };
  for (int i = 0; i <= 4; ++i) path.states.push_back({at(0.3 * i), 0.3 * i, 1.0 / kRadius});
  path.elements.assign(4, PathElement{.typical = false});
  for (int i = 0; i <= 200; ++i) {
    const double angle = 1.2 * i / 200.0;
    data.points.push_back(at(angle) + noise(random) * Vec2(-std::sin(angle), std::cos(angle)));
  }
  data.start = path.states.front().point;
  data.end = path.states.back().point;
  const auto fitted = fitPath(path, data, 25);
  ASSERT_TRUE(fitted);
  EXPECT_TRUE(fitted->fit.converged);
  EXPECT_NEAR(fitted->fit.rms, 0.3, 0.05);
  for (std::size_t s = 0; s < path.states.size(); ++s) {
    EXPECT_EQ(fitted->path.states[s].point, path.states[s].point);
    EXPECT_EQ(fitted->path.states[s].angleRad, path.states[s].angleRad);
    EXPECT_EQ(fitted->path.states[s].kappa, path.states[s].kappa);
  }
}

// A corner that nobody marked is a turn within a few tenths of a pixel. A segment as short would be refused, and the
// chain with it.
TEST(TiledPath, LeavesNoSliversInSharpTurns) {
  for (const double rounding : {0.15, 0.3, 0.6}) {
    TypicalLine line;
    const double side = 100.0 + rounding;
    auto fair = NurbsCurve::make(
        2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3},
        {{0, 0}, {50, 8}, {100, 0}, {side, -0.16 * rounding}, {side, rounding}, {side, 50}, {110, 100}});
    ASSERT_TRUE(fair);
    line.fair = std::move(*fair);
    const auto path = tiledPath(line);
    ASSERT_TRUE(path);
    EXPECT_FALSE(firstSliver(*path)) << rounding;
    EXPECT_LT((path->states.back().point - Vec2(110, 100)).norm(), 0.5);  // the fit closes the rest
  }
}

// Points wide apart, with more elements between two of them than a search from foot to foot leads across.
TEST(PathFeet, AreFoundAcrossManyShortElements) {
  TypicalPath path;
  constexpr int kShortOnes = 60;
  for (int i = 0; i <= kShortOnes; ++i) path.states.push_back({Vec2(100.0 + i, 0.0), 0.0, 0.0});
  path.states.insert(path.states.begin(), {Vec2(0.0, 0.0), 0.0, 0.0});
  path.states.push_back({Vec2(300.0, 0.0), 0.0, 0.0});
  path.elements.assign(path.states.size() - 1, PathElement{.typical = false});
  std::vector<PathFoot> feet;
  followFeet(geometryOf(path), {{10, 1}, {90, 1}, {170, 1}, {250, 1}}, feet);
  for (const PathFoot& foot : feet) EXPECT_NEAR(foot.distance, 1.0, 1e-9);
  EXPECT_EQ(feet.back().element, path.elements.size() - 1);
}

TEST(TypicalPath, SplittingATypicalElementIsExact) {
  TypicalPath path = somePath();
  const TypicalCurve whole = path.typical(1);
  path.split(1, 0.3);
  ASSERT_EQ(path.elements.size(), 4u);
  const auto q = path.typical(1).controlPoints(), r = path.typical(2).controlPoints(), w = whole.controlPoints();
  // De Casteljau on the whole.
  std::array<Vec2, 4> b = w;
  for (std::size_t n = 3; n > 0; --n) {
    for (std::size_t i = 0; i < n; ++i) b[i] += 0.3 * (b[i + 1] - b[i]);
  }
  EXPECT_LT((q[3] - b[0]).norm(), 0.05);  // the trends leave a hair of slack
  EXPECT_LT((r[3] - w[3]).norm(), 0.5);
}

TEST(FitPath, FindsTheCurveItsPointsCameFrom) {
  const TypicalPath truth = somePath();
  PathData data;
  for (std::size_t e = 0; e < truth.elements.size(); ++e) {
    const Quintic q = truth.quintic(e);
    const auto curve = NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {q.begin(), q.end()}).value();
    for (int i = 0; i < 40; ++i) data.points.push_back(curve.point(i / 40.0));
  }
  data.start = truth.states.front().point;
  data.end = truth.states.back().point;
  data.fairness = 0.0;
  TypicalPath path = truth;
  path.states[0].angleRad += 0.02;
  path.states[0].kappa *= 1.2;
  path.elements[0].logTurn += 0.2;
  path.elements[1].shape += 0.1;
  const auto fitted = fitPath(path, data, 60);
  ASSERT_TRUE(fitted);
  EXPECT_LT(fitted->fit.rms, 0.02);
  EXPECT_NEAR(fitted->path.states[0].angleRad, 0.1, 2e-3);
}

TEST(FitPath, ClosesExactlyAndMeetsPinnedEnds) {
  // A closed ring of eight typical curves around an ellipse.
  TypicalPath path;
  path.closed = true;
  path.states.resize(9);
  PathData data;
  for (int i = 0; i < 400; ++i)
    data.points.push_back(test::ellipsePoint(std::numbers::pi / 2 + 2 * std::numbers::pi * i / 400));
  path.states[0] = {test::ellipsePoint(std::numbers::pi / 2), std::numbers::pi, 150.0 / 90000.0};
  for (int k = 0; k < 8; ++k) path.elements.push_back(typicalElement(std::numbers::pi / 8, 0.0, Trend::Free));
  // Curvature of the ellipse at equal turns.
  const auto kappa = [](double turn) {
    const double s = std::sin(turn), c = std::cos(turn);
    return std::pow(150.0 * 150.0 * c * c + 300.0 * 300.0 * s * s, 1.5) / (300.0 * 300.0 * 150.0 * 150.0);
  };
  for (int k = 0; k < 8; ++k) {
    path.elements[k].shape = 0.25 * std::log(kappa(k * std::numbers::pi / 4) / kappa((k + 1) * std::numbers::pi / 4));
  }
  const auto fitted = fitPath(path, data, 60);
  ASSERT_TRUE(fitted);
  EXPECT_LT(fitted->fit.rms, 0.5);
  const PathState &first = fitted->path.states.front(), &last = fitted->path.states.back();
  EXPECT_LT((last.point - first.point).norm(), 1e-9);
  EXPECT_NEAR(last.angleRad - first.angleRad, 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(last.kappa, first.kappa, 1e-12);

  TypicalPath open = somePath();
  open.elements.pop_back();
  open.states.pop_back();
  PathData ends;
  for (int i = 0; i <= 20; ++i)
    ends.points.push_back(open.states[0].point + (open.states[2].point - open.states[0].point) * i / 20.0);
  ends.start = open.states[0].point + Vec2(0.5, 0.2);
  ends.end = open.states[2].point + Vec2(-0.3, 0.4);
  const auto pinned = fitPath(open, ends, 40);
  ASSERT_TRUE(pinned);
  EXPECT_EQ(pinned->path.states.front().point, ends.start);
  EXPECT_LT((pinned->path.states.back().point - ends.end).norm(), 1e-9);
}

/// A spiral with a stretch in the middle that has no points, on a page turned by an angle.
TypicalLine lineWithGap(double turnRad) {
  const auto rotated = [turnRad](const Vec2& v) {
    return Vec2(std::cos(turnRad) * v.x() - std::sin(turnRad) * v.y(),
                std::sin(turnRad) * v.x() + std::cos(turnRad) * v.y());
  };
  TypicalLine line;
  Vec2 at = Vec2::Zero();
  double angle = 0.3;
  for (int i = 0; i <= 1000; ++i) {
    const double kappa = 0.002 + 4e-6 * i;
    if (i % 40 == 0) line.joints.push_back({rotated(at), rotated({std::cos(angle), std::sin(angle)}), kappa});
    if (i < 300 || i > 700) line.points.push_back(rotated(at));
    angle += 0.5 * kappa;
    at += Vec2(std::cos(angle), std::sin(angle));
    angle += 0.5 * kappa;
  }
  line.end = line.joints.back().point;
  return line;
}

TEST(GrownPath, TurnsWithThePageAlsoWhereThereAreNoPoints) {
  const auto pathOn = [](double turnRad) {
    const TypicalLine line = lineWithGap(turnRad);
    const std::vector<Vec2> breakpoints = {line.joints[9].point, line.joints[16].point};
    return grownPath(line, breakpoints, {}, StepRecord::None, {}).found->path;
  };
  const TypicalPath upright = pathOn(0.0);
  // Also such that the middle of the gap runs along the axes of the page.
  for (double turn = -1.7; turn < -1.3; turn += 0.03) {
    const TypicalPath turned = pathOn(turn);
    ASSERT_EQ(turned.elements.size(), upright.elements.size());
    for (std::size_t i = 0; i < upright.states.size(); ++i) {
      EXPECT_NEAR(turned.states[i].point.norm(), upright.states[i].point.norm(), 1e-5) << i;
      EXPECT_NEAR(turned.states[i].kappa, upright.states[i].kappa, 1e-8) << i;
      EXPECT_NEAR(std::remainder(turned.states[i].angleRad - upright.states[i].angleRad - turn, 2.0 * std::numbers::pi),
                  0.0, 1e-6);
    }
  }
}

TEST(FormGradient, MatchesTheKnownAnswer) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, "05_typical.json");
  for (const auto& item : answer.at("cases")) {
    const auto number = [&](const char* key) { return item.at(key).get<double>(); };
    const auto curve = typicalFromForm(Vec2::Zero(), 0.0, number("kappa0"), number("dS"), number("dW"));
    ASSERT_TRUE(curve);
    const FormGradient g = formGradient(*curve);
    EXPECT_NEAR(g.edgeByTurn, number("dl_dphi"), 1e-9 * std::abs(number("dl_dphi")));
    EXPECT_NEAR(g.ratioByTurn, number("dh_dphi"), 1e-9 * std::abs(number("dh_dphi")));
    const Vec2 expected = test::toVec2(item.at("dC1_dphi"));
    EXPECT_LT((g.endByTurn - expected).norm(), 1e-9 * expected.norm());
  }
}

}  // namespace
}  // namespace batten
