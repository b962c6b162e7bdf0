// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solve/small_least_squares.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace batten {
namespace {

struct Sample {
  double x = 0.0, y = 0.0, weight = 1.0;
};

std::vector<Sample> samplesOfALine(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Sample> samples;
  for (int i = 0; i < 20; ++i) samples.push_back({5.0 * any(random), any(random), 1.0 + 0.5 * any(random)});
  return samples;
}

/// (place at 0, slope) in closed form: by the weighted means, the variance of x and the covariance.
Eigen::Vector2d lineThrough(const std::vector<Sample>& samples) {
  double weight = 0.0, x = 0.0, y = 0.0, variance = 0.0, covariance = 0.0;
  for (const Sample& s : samples) weight += s.weight, x += s.weight * s.x, y += s.weight * s.y;
  x /= weight, y /= weight;
  for (const Sample& s : samples) {
    variance += s.weight * (s.x - x) * (s.x - x);
    covariance += s.weight * (s.x - x) * (s.y - y);
  }
  return {y - covariance / variance * x, covariance / variance};
}

TEST(SmallLeastSquares, IsTheClosedFormOfALine) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<Sample> samples = samplesOfALine(seed);
    SmallLeastSquares<2> fit;
    for (const Sample& s : samples) fit.add({1.0, s.x}, s.y, s.weight);
    EXPECT_TRUE(fit.solve().isApprox(lineThrough(samples), 1e-9)) << "seed " << seed;
  }
}

TEST(SmallLeastSquares, APartAndTheRestAreTheWhole) {
  const std::vector<Sample> samples = samplesOfALine(7);
  SmallLeastSquares<2> fit, rest;
  for (std::size_t i = 0; i < samples.size(); ++i)
    (i < 8 ? fit : rest).add({1.0, samples[i].x}, samples[i].y, samples[i].weight);
  fit.add(rest);
  EXPECT_TRUE(fit.solve().isApprox(lineThrough(samples), 1e-9));
}

TEST(SmallLeastSquares, EachSideHasUnknownsOfItsOwn) {
  std::vector<Sample> first = samplesOfALine(11), second = samplesOfALine(12);
  SmallLeastSquares<2, 2> both;
  for (std::size_t i = 0; i < first.size(); ++i) {
    second[i].x = first[i].x;
    first[i].weight = second[i].weight = 1.0;
    both.add({1.0, first[i].x}, {first[i].y, second[i].y});
  }
  const Eigen::Matrix2d found = both.solve();
  EXPECT_TRUE(found.col(0).isApprox(lineThrough(first), 1e-9));
  EXPECT_TRUE(found.col(1).isApprox(lineThrough(second), 1e-9));
}

TEST(SmallLeastSquares, WhatIsHeldFirmlyDoesNotMove) {
  SmallLeastSquares<2> fit;
  for (const Sample& s : samplesOfALine(3)) fit.add({1.0, s.x}, s.y);
  fit.hold({0.0, 1e12}, {0.0, 0.25});
  EXPECT_NEAR(fit.solve()[1], 0.25, 1e-9);
}

// All at one place: a line through it may have any slope.
TEST(SmallLeastSquares, ASingularFitGoesThroughWhatItHas) {
  SmallLeastSquares<2> fit;
  for (int i = 0; i < 3; ++i) fit.add({1.0, 2.0}, 5.0);
  const Eigen::Vector2d any = fit.solve();
  EXPECT_NEAR(any[0] + 2.0 * any[1], 5.0, 1e-9);
  fit.hold({1e-6, 1e-6});
  const Eigen::Vector2d least = fit.solve();  // of all lines through it the one with the smallest squares
  EXPECT_NEAR(least[0], 1.0, 1e-5);
  EXPECT_NEAR(least[1], 2.0, 1e-5);
}

TEST(SmallLeastSquares, WhatNoRowTouchesIsZero) {
  EXPECT_EQ(SmallLeastSquares<3>().solve(), Eigen::Vector3d::Zero());
  SmallLeastSquares<2> fit;
  fit.add({2.0, 0.0}, 6.0);
  EXPECT_EQ(fit.solve(), Eigen::Vector2d(3.0, 0.0));
}

}  // namespace
}  // namespace batten
