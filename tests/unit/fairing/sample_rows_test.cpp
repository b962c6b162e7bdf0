// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/sample_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/fairing/model/target_steps.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

/// The rows of all samples as one dense matrix, by what one unknown after the other changes.
Eigen::MatrixXd denseRows(const SampleRows& rows, int unknowns, int samples, bool across) {
  Eigen::MatrixXd dense(samples, unknowns);
  for (int k = 0; k < unknowns; ++k) {
    const auto moves = rows.times(Eigen::VectorXd::Unit(unknowns, k));
    dense.col(k) = across ? moves.across : moves.along;
  }
  return dense;
}

void checkSquares(const NurbsCurve& curve, bool closed) {
  const auto made = makeSetup(curve, closed, {});
  ASSERT_TRUE(made) << made.error().message;
  const FairingSetup& setup = **made;
  const int count = setup.sampleCount(), unknowns = setup.unknowns.count();
  SampleRows rows;
  rows.reset(setup.unknowns, setup.start);
  SampleRows::Squares squares{{}, 0.7, 2.0, 3.0};
  Eigen::VectorXd ofAcross(count);
  for (int i = 0; i < count; ++i) {
    LocalRow row;
    for (std::size_t j = 0; j < row.size(); ++j)
      row[j] = Vec2(std::sin(i + 0.3 * double(j)), std::cos(2.0 * i + double(j)));
    for (const auto which : {SampleRows::Curvature, SampleRows::Across, SampleRows::Along}) {
      rows.set(i, which, setup.start.places[i].span, row);
      for (Vec2& value : row) value = Vec2(value.y() - 0.5, 0.3 + value.x());
    }
    ofAcross[i] = 1.0 + 0.5 * std::sin(0.1 * i);
    squares.weights.push_back({0.0, ofAcross[i]});
  }
  BandedMatrix stiffness(unknowns, setup.unknowns.halfWidth(), false), mass = stiffness;
  rows.addSquares(squares, {}, stiffness, mass);
  const Eigen::MatrixXd across = denseRows(rows, unknowns, count, true),
                        along = denseRows(rows, unknowns, count, false);
  const Eigen::MatrixXd wantedStiffness =
      across.transpose() * ofAcross.asDiagonal() * across + 0.7 * 2.0 * along.transpose() * along;
  const Eigen::MatrixXd wantedMass = 0.7 * across.transpose() * across + 0.7 * 3.0 * along.transpose() * along;
  const double largest = wantedStiffness.cwiseAbs().maxCoeff() + wantedMass.cwiseAbs().maxCoeff();
  for (int i = 0; i < unknowns; ++i) {
    for (int k = 0; k <= setup.unknowns.halfWidth() && i + k < unknowns; ++k) {
      EXPECT_NEAR(stiffness.entry(i, k), wantedStiffness(i, i + k), 1e-12 * largest);
      EXPECT_NEAR(mass.entry(i, k), wantedMass(i, i + k), 1e-12 * largest);
    }
  }
  Eigen::VectorXd y(count), out = Eigen::VectorXd::Zero(unknowns);
  for (int i = 0; i < count; ++i) y[i] = std::cos(0.37 * i);
  rows.addTransposed(y, out);
  EXPECT_LT((out - across.transpose() * y).norm(), 1e-12 * largest);
}

TEST(SampleRows, SquaresAreThoseOfTheDenseRows) {
  checkSquares(test::noisy(test::ellipseQuarter(200, 120, 16), 0.5, 3), false);
  const auto oval = [](double f) {
    const double a = 2.0 * std::numbers::pi * f;
    return Vec2(100.0 * std::cos(a), 60.0 * std::sin(a));
  };
  checkSquares(test::closedCurve(oval, 24), true);
}

TEST(TargetSteps, AreWithinADistanceWhereTheirDeviationIs) {
  const NurbsCurve curve = test::noisy(test::wave(300.0, 20.0, 24), 0.5, 3);
  const auto setup = makeSetup(curve, false, {});
  ASSERT_TRUE(setup);
  const auto objective = targetObjective(**setup, fitTargets(curve, {}).profiles[0]);
  ASSERT_TRUE(objective);
  const TargetSteps followed(**setup, *objective, {});
  ASSERT_FALSE(followed.steps().empty());
  for (const TargetStep& step : followed.steps()) {
    const double deviation = largestDeviation(**setup, step.points, true);
    for (const double share : {0.01, 0.5, 0.999, 1.0, 1.001, 1.9, 100.0}) {
      TargetStep unmeasured;
      unmeasured.points = step.points;
      unmeasured.setup = step.setup;
      EXPECT_EQ(unmeasured.isWithin(share * deviation), share >= 1.0) << share << " of " << deviation;
      EXPECT_EQ(unmeasured.deviationMm(), deviation);
    }
  }
}

TEST(Targets, OneFittedAloneIsThatOfAll) {
  const NurbsCurve curve = test::noisy(test::wave(300.0, 20.0, 24), 0.5, 3);
  TargetParams params;
  params.splits = {0.3, 0.6};
  const TargetSet all = fitTargets(curve, params);
  for (int degree = 1; degree <= kMostTargetDegree; ++degree) {
    const TargetProfile one = fitTarget(curve, params, false, degree);
    for (int i = 0; i <= 40; ++i) EXPECT_EQ(one.value(i / 40.0), all.profiles[degree - 1].value(i / 40.0));
  }
}

}  // namespace
}  // namespace batten
