// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace batten {
namespace {

/// (f(x))^2 of one unknown, with a record of what was asked.
class OneUnknown : public LevenbergProblem {
 public:
  OneUnknown(double start, double (*f)(double), double (*slope)(double)) : x(start), f_(f), slope_(slope) {}
  double linearise() override {
    ++models;
    return f_(x) * f_(x);
  }
  double tryStep(double damping) override {
    dampings.push_back(damping);
    const double j = slope_(x);
    trial_ = x - j * f_(x) / (j * j * (1.0 + damping));
    return f_(trial_) * f_(trial_);
  }
  void accept() override { x = trial_; }
  bool isReached() const override { return enough > 0.0 && std::abs(f_(x)) < enough; }

  double x, enough = 0.0;
  int models = 0;
  std::vector<double> dampings;

 private:
  double (*f_)(double);
  double (*slope_)(double);
  double trial_ = 0.0;
};

double squareMinusTwo(double x) { return x * x - 2.0; }
double twice(double x) { return 2.0 * x; }
double arcTangent(double x) { return std::atan(x); }
double arcTangentSlope(double x) { return 1.0 / (1.0 + x * x); }

TEST(LevenbergMarquardt, FindsARootToTheLastPlaces) {
  OneUnknown problem(3.0, squareMinusTwo, twice);
  LevenbergOptions options;
  options.negligible = 1e-24;
  const LevenbergRun run = levenbergMarquardt(problem, options, {});
  EXPECT_EQ(run.why, Termination::Converged);
  EXPECT_NEAR(problem.x, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(run.iterations, problem.models);
  EXPECT_LT(run.damping, 1e-3);
}

TEST(LevenbergMarquardt, RaisesTheDampingUntilAStepDecreases) {
  // From beyond 1.39 the undamped step for the arc tangent overshoots to a place farther out.
  OneUnknown problem(20.0, arcTangent, arcTangentSlope);
  const LevenbergRun run = levenbergMarquardt(problem, {}, {});
  EXPECT_NEAR(problem.x, 0.0, 1e-9);
  EXPECT_EQ(run.why, Termination::Converged);
  ASSERT_GT(problem.dampings.size(), 2u);
  EXPECT_EQ(problem.dampings[0], 1e-3);
  EXPECT_EQ(problem.dampings[1], 4e-3);
}

TEST(LevenbergMarquardt, StopsWhereTheProblemSaysItIsEnough) {
  OneUnknown problem(3.0, squareMinusTwo, twice);
  problem.enough = 0.5;
  const LevenbergRun run = levenbergMarquardt(problem, {}, {});
  EXPECT_EQ(run.why, Termination::FixedPoint);
  EXPECT_LT(std::abs(squareMinusTwo(problem.x)), 0.5);
  EXPECT_GT(std::abs(squareMinusTwo(problem.x)), 1e-3);
}

TEST(LevenbergMarquardt, KeepsTheStateWhereNoStepDecreases) {
  OneUnknown problem(
      1.0, [](double) { return 1.0; }, [](double) { return 1.0; });
  LevenbergOptions options;
  options.attempts = 3;
  const LevenbergRun run = levenbergMarquardt(problem, options, {});
  EXPECT_EQ(run.why, Termination::NoProgress);
  EXPECT_EQ(problem.x, 1.0);
  EXPECT_EQ(problem.dampings.size(), 3u);
  OneUnknown bounded(
      1.0, [](double) { return 1.0; }, [](double) { return 1.0; });
  LevenbergOptions limited;
  limited.mostDamping = 1.0;  // 1e-3 * 4^5 is above
  levenbergMarquardt(bounded, limited, {});
  EXPECT_EQ(bounded.dampings.size(), 5u);
}

TEST(LevenbergMarquardt, SaysWhenItHasNotSettled) {
  OneUnknown problem(20.0, arcTangent, arcTangentSlope);
  LevenbergOptions options;
  options.iterations = 1;
  EXPECT_EQ(levenbergMarquardt(problem, options, {}).why, Termination::IterationLimit);
  EXPECT_EQ(problem.models, 1);
}

TEST(LevenbergMarquardt, SmallStepsUnderHeavyDampingProveLittle) {
  // With a damping of 1e6 a step closes a millionth of the way: small, though the bottom is far.
  const auto run = [](int damped) {
    OneUnknown problem(3.0, squareMinusTwo, twice);
    LevenbergOptions options;
    options.damping = 1e6;
    options.success = 1.0;
    options.smallSteps = 1;
    options.smallStepsDamped = damped;
    return levenbergMarquardt(problem, options, {}).iterations;
  };
  EXPECT_EQ(run(1), 1);
  EXPECT_EQ(run(7), 7);
}

TEST(LevenbergMarquardt, RefusesAnImpossibleStartAndHearsACancel) {
  OneUnknown impossible(
      -1.0, [](double x) { return std::sqrt(x); }, [](double) { return 1.0; });
  EXPECT_EQ(levenbergMarquardt(impossible, {}, {}).why, Termination::Degenerate);
  RunContext context;
  context.cancel.cancel();
  OneUnknown problem(3.0, squareMinusTwo, twice);
  EXPECT_EQ(levenbergMarquardt(problem, {}, context).iterations, 0);
  EXPECT_EQ(problem.x, 3.0);
}

}  // namespace
}  // namespace batten
