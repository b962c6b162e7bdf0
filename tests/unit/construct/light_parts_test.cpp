// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "core/construct/light/exact_shape.h"
#include "core/construct/light/light_rows.h"
#include "core/construct/light/light_system.h"
#include "core/construct/light/removal_deviation.h"
#include "core/construct/light/switch_places.h"
#include "tests/unit/construct/light_shapes.h"

namespace batten {
namespace {

test::TruthPiece lineOf(const std::function<double(double)>& kappa, double length) {
  test::TruthPiece piece;
  const int steps = 8000;
  Vec2 p = Vec2::Zero();
  double angle = 0.0;
  const double h = length / steps;
  for (int i = 0; i <= steps; ++i) {
    piece.points.push_back(p);
    piece.kappa.push_back(kappa(i * h));
    const double turn = h * kappa((i + 0.5) * h);
    p += h * Vec2(std::cos(angle + 0.5 * turn), std::sin(angle + 0.5 * turn));
    angle += turn;
  }
  return piece;
}

LightReference referenceOf(const test::TruthPiece& piece, bool closed) {
  auto reference = LightReference::make(test::denseCurve(piece, closed), closed, 0.5);
  if (!reference) throw std::runtime_error("no reference");
  return std::move(*reference);
}

/// Least cost over every way to place the changes.
double cheapest(const std::vector<double>& rising, const std::vector<double>& falling, int first, int changes,
                std::size_t from) {
  const auto& costs = first > 0 ? falling : rising;
  double best = std::numeric_limits<double>::infinity(), here = 0.0;
  for (std::size_t end = from + 1; end <= rising.size(); ++end) {
    here += costs[end - 1];
    if (changes == 0) {
      if (end == rising.size()) best = std::min(best, here);
    } else if (end < rising.size()) {
      best = std::min(best, here + cheapest(rising, falling, -first, changes - 1, end));
    }
  }
  return best;
}

TEST(SwitchPlaces, CostAsLittleAsTheBestOfAllWays) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> cost(0.0, 1.0);
  SwitchPlaces places;
  for (int round = 0; round < 40; ++round) {
    std::vector<double> rising, falling;
    for (int i = 0; i < 9; ++i) {
      rising.push_back(cost(random) < 0.5 ? 0.0 : cost(random));
      falling.push_back(rising.back() > 0.0 ? 0.0 : cost(random));
    }
    const int changes = round % 4, first = round % 8 < 4 ? 1 : -1;
    const auto signs = places.choose(rising, falling, first, changes);
    ASSERT_EQ(signs.size(), 9u);
    EXPECT_EQ(signs.front(), first);
    int turned = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < 9; ++i) {
      if (i > 0 && signs[i] != signs[i - 1]) ++turned;
      sum += signs[i] > 0 ? falling[i] : rising[i];
    }
    EXPECT_EQ(turned, changes);
    EXPECT_NEAR(sum, cheapest(rising, falling, first, changes, 0), 1e-12);

    const auto few = places.choose(rising, falling, first, changes, SwitchPlaces::Changes::AtMost);
    double fewest = std::numeric_limits<double>::infinity(), took = 0.0;
    for (int k = 0; k <= changes; ++k) {
      fewest = std::min(fewest, cheapest(rising, falling, first, k, 0));
      if (k < changes) fewest = std::min(fewest, cheapest(rising, falling, -first, k, 0));
    }
    for (std::size_t i = 0; i < 9; ++i) took += few[i] > 0 ? falling[i] : rising[i];
    EXPECT_NEAR(took, fewest, 1e-12);
  }
}

TEST(RemovalDeviation, OfASineIsItsAmplitudeInSpace) {
  // kappa = a sin(2 pi s / w) bends the line by a (w / 2 pi)^2.
  const double amplitude = 2e-4, wave = 100.0;
  const auto line = lineOf([&](double s) { return 1e-3 + amplitude * std::sin(2 * std::numbers::pi * s / wave); }, 600);
  const auto ranked = rankedExtrema(referenceOf(line, false), 1e-6);
  ASSERT_EQ(ranked.size(), 12u);
  const double expected = amplitude * std::pow(wave / (2 * std::numbers::pi), 2);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    ASSERT_TRUE(ranked[i].removal);
    EXPECT_EQ(ranked[i].maximum, i % 2 == 0);
    EXPECT_NEAR(ranked[i].s, wave * (0.25 + 0.5 * static_cast<double>(i)), 1.0);
  }
  const double least = std::min_element(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
                         return *a.removal < *b.removal;
                       })->removal.value();
  EXPECT_LE(least, 1.05 * expected);
  EXPECT_EQ(significantExtrema(ranked, 0.0).size(), 12u);
  EXPECT_TRUE(significantExtrema(ranked, 1e9).empty());
  // What is left alternates, whatever is asked for.
  for (const double asked : {0.5 * expected, expected, 2.0 * expected, 8.0 * expected}) {
    const auto kept = significantExtrema(ranked, asked);
    for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_NE(kept[i].maximum, kept[i - 1].maximum);
  }
}

/// What is removed in which order when all that is left is looked through for every removal: the oracle.
std::vector<double> removedOneByOne(const LightReference& reference, const std::vector<RankedExtremum>& all) {
  std::vector<double> removal(all.size(), -1.0);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < all.size(); ++i) left.push_back(i);
  const bool closed = reference.isClosed();
  const auto move = [&](double kappa, double length) {
    if (length < 0.0) length += reference.length();
    return std::abs(kappa) * length * length / (2.0 * std::numbers::pi * std::numbers::pi);
  };
  double dearest = 0.0;
  while (!left.empty() && !(closed && left.size() <= 4)) {
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> gone;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < left.size(); ++i) {
      const std::size_t a = left[i], b = left[(i + 1) % left.size()];
      const double cost = move(all[b].kappa - all[a].kappa, all[b].s - all[a].s);
      if (cost < best) best = cost, gone = {a, b};
    }
    const auto offerEnd = [&](std::size_t which, const LightSample& end) {
      const double cost = move(end.kappa - all[which].kappa, std::abs(end.s - all[which].s));
      if (cost < best) best = cost, gone = {which};
    };
    if (!closed) offerEnd(left.front(), reference.samples().front());
    if (!closed) offerEnd(left.back(), reference.samples().back());
    dearest = std::max(dearest, best);
    for (const std::size_t which : gone) {
      removal[which] = dearest;
      std::erase(left, which);
    }
  }
  return removal;
}

TEST(RemovalDeviation, IsThatOfASearchThroughAllThatAreLeft) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int round = 0; round < 12; ++round) {
    std::vector<double> height, phase;
    for (int k = 0; k < 9; ++k) height.push_back(share(random)), phase.push_back(6.3 * share(random));
    // Every third line is an even wave: equal costs, of which the first counts.
    const auto kappa = [&](double s) {
      if (round % 3 == 0) return 1e-3 + 4e-4 * std::sin(2.0 * std::numbers::pi * s / 50.0);
      double sum = 1e-3;
      for (int k = 0; k < 9; ++k) sum += 1e-4 * height[k] * std::sin(0.02 * (k + 1) * s + phase[k]);
      return sum;
    };
    const LightReference open = referenceOf(lineOf(kappa, 900), false);
    const auto ranked = rankedExtrema(open, 1e-9);
    EXPECT_GT(ranked.size(), 10u);
    const auto truth = removedOneByOne(open, ranked);
    for (std::size_t i = 0; i < ranked.size(); ++i) EXPECT_EQ(ranked[i].removal.value_or(-1.0), truth[i]) << round;
  }
  std::vector<Vec2> flower;
  for (int i = 0; i < 1500; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 1500.0;
    const double r = 200.0 + 3.0 * std::sin(7.0 * a) + 1.3 * std::cos(17.0 * a + 1.0) + 0.7 * std::sin(29.0 * a);
    flower.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  const auto around = LightReference::through(flower, true);
  ASSERT_TRUE(around);
  const auto ranked = rankedExtrema(*around, 1e-6);
  EXPECT_GT(ranked.size(), 20u);
  const auto truth = removedOneByOne(*around, ranked);
  for (std::size_t i = 0; i < ranked.size(); ++i) EXPECT_EQ(ranked[i].removal.value_or(-1.0), truth[i]);
  EXPECT_EQ(significantExtrema(ranked, std::numeric_limits<double>::max()).size(), 4u);
}

TEST(RemovalDeviation, LeavesAnEllipseItsFour) {
  const auto truth = test::truthShape("ellipse", 640, 480);
  const auto ranked = rankedExtrema(referenceOf(truth.pieces[0], true), 1e-6);
  ASSERT_EQ(ranked.size(), 4u);
  for (const auto& extremum : ranked) EXPECT_FALSE(extremum.removal);
}

TEST(ExactShape, KnowsLinesArcsAndCircles) {
  const auto straight = referenceOf(lineOf([](double) { return 0.0; }, 200), false);
  const auto line = exactLine(straight, 0.05);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->degree(), 1);
  EXPECT_EQ(line->controlPointCount(), 2);
  for (const double turn : {1.0, 2.6, 5.5}) {
    const auto bent = referenceOf(lineOf([&](double) { return -turn / 400.0; }, 400), false);
    EXPECT_FALSE(exactLine(bent, 0.05));
    const auto arc = exactArc(bent, 0.05);
    ASSERT_TRUE(arc);
    EXPECT_LE(arc->controlPointCount(), turn < 2.0 ? 3 : turn < 4.0 ? 5 : 7);
    for (const double kappa : test::curvaturesOn(*arc, 60, false)) EXPECT_NEAR(kappa, -turn / 400.0, 1e-6);
    EXPECT_LT((arc->point(arc->end()) - bent.samples().back().point).norm(), 1e-9);
  }
  const auto circle = exactArc(referenceOf(test::truthShape("circle", 640, 480).pieces[0], true), 0.05);
  ASSERT_TRUE(circle);
  const auto around = test::curvaturesOn(*circle, 90, true);
  for (const double kappa : around) EXPECT_NEAR(kappa, around.front(), 1e-9);
  const auto spiral = referenceOf(lineOf([](double s) { return 1e-3 + 1e-5 * s; }, 400), false);
  EXPECT_FALSE(exactLine(spiral, 0.2));
  EXPECT_FALSE(exactArc(spiral, 0.2));
}

TEST(LightRows, GradientsAgreeWithDifferences) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Vec2 direction = Vec2(0.6, 0.8);
  for (int round = 0; round < 20; ++round) {
    PlaceState place;
    for (Vec2& d : place.d) d = Vec2(any(random), any(random));
    place.d[1] += Vec2(2.0, 0.0);
    completePlace(place);
    const std::array<DerivativeGradients, 4> gradients{kappaGradient(place), slopeGradient(place), speedGradient(place),
                                                       tangentGradient(place, direction)};
    const auto valuesAt = [&](std::size_t order, Eigen::Index axis, double step) {
      PlaceState moved = place;
      moved.d[order][axis] += step;
      completePlace(moved);
      return std::array<double, 4>{moved.kappa, moved.slope, moved.speed, moved.d[1].dot(direction) / moved.speed};
    };
    for (std::size_t order = 1; order < 4; ++order) {
      for (const Eigen::Index axis : {0, 1}) {
        const double step = 1e-6;
        const auto above = valuesAt(order, axis, step), below = valuesAt(order, axis, -step);
        for (std::size_t k = 0; k < 4; ++k) {
          EXPECT_NEAR(gradients[k][order][axis], (above[k] - below[k]) / (2.0 * step), 1e-7) << k << " by " << order;
        }
      }
    }
  }
}

/// The gradient of the system against differences of its own cost.
void expectGradient(const LightReference& reference, LightShape shape, const LightAsk& ask) {
  LightSystem system(reference, ask, shape);
  // Without the rows of signs and ends, whose unit, the length of a span, is taken as it is; their own gradients are
  // looked at above.
  const LightWeights weights{1.0, 12.0, 0.0, 0.0};
  std::mt19937 random(8);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    if (shape.closed || (i > 0 && i + 1 < shape.points.size())) shape.points[i] += Vec2(noise(random), noise(random));
  }
  if (shape.spans() > 1) {
    for (double& q : shape.logLengths) q += 0.1 * noise(random);
  }
  ASSERT_TRUE(system.evaluate(shape, weights).sound);
  LightMatrix matrix(shape, shape.spans() > 1);
  Eigen::VectorXd gradient(system.unknowns());
  system.gauss(shape, weights, matrix, gradient);
  const auto costOf = [&](Eigen::Index unknown, double step) {
    LightShape moved = shape;
    if (unknown < system.firstLength()) {
      moved.points[unknown / 2][unknown % 2] += step;
    } else {
      moved.logLengths[unknown - system.firstLength()] += step;
    }
    return 0.5 * system.evaluate(moved, weights).squares;
  };
  const double largest = gradient.cwiseAbs().maxCoeff();
  ASSERT_GT(largest, 0.0);
  for (Eigen::Index i = 0; i < system.unknowns(); ++i) {
    const bool pinned = !shape.closed && (i < 2 || (i >= system.firstLength() - 2 && i < system.firstLength()));
    if (pinned) {
      EXPECT_EQ(gradient[i], 0.0);
      continue;
    }
    const double step = 1e-5;
    const double difference = (costOf(i, step) - costOf(i, -step)) / (2.0 * step);
    // The mean speed is taken as it is: a very small part is missing.
    EXPECT_NEAR(gradient[i], difference, 2e-3 * largest) << "unknown " << i;
  }
}

TEST(LightSystem, GradientAgreesWithDifferences) {
  const auto roof = referenceOf(test::truthShape("car", 640, 480).pieces[0], false);
  LightAsk ask;
  ask.tolerance = 0.5;
  ask.firstSlope = LightSign::Positive;
  ask.changes = 3;
  ask.firstKappa = LightSign::Positive;
  ask.start = ask.end = LightHold::Curvature;
  for (const int spans : {1, 3, 6}) {
    SCOPED_TRACE(spans);
    const auto start = startShape(roof, 5, spans, BreakStart::ByShape);
    ASSERT_TRUE(start);
    expectGradient(roof, *start, ask);
  }
  const auto around = referenceOf(test::truthShape("ellipse", 640, 480).pieces[0], true);
  ask.changes = 4;
  ask.firstSlope = LightSign::Negative;
  for (const int spans : {5, 10}) {
    SCOPED_TRACE(spans);
    const auto start = startShape(around, 5, spans, BreakStart::Even);
    ASSERT_TRUE(start);
    expectGradient(around, *start, ask);
  }
}

}  // namespace
}  // namespace batten
