// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/target_profiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fairing/profile/polynomial_fit.h"
#include "core/fairing/profile/similarity.h"
#include "tests/support/known_answers.h"
#include "tests/unit/fairing/fairing_curves.h"

namespace batten {
namespace {

double evaluateAt(const std::vector<double>& c, double f) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) v = v * f + c[k];
  return v;
}

double rms(const std::vector<double>& c, const std::vector<double>& f, const std::vector<double>& y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) sum += std::pow(evaluateAt(c, f[i]) - y[i], 2);
  return std::sqrt(sum / static_cast<double>(f.size()));
}

TEST(TargetProfiles, MatchesTheKnownPolynomialsAndTheirSimilarity) {
  const auto data = test::knownAnswer(BATTEN_TEST_DATA, "06_target_similarity.json");
  for (const auto& curve : data.at("curves")) {
    const auto rho = curve.at("rho").get<std::vector<double>>();
    std::vector<double> f(rho.size());
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = static_cast<double>(i) / static_cast<double>(f.size() - 1);
    for (const auto& known : curve.at("degrees")) {
      SCOPED_TRACE(curve.at("name").get<std::string>() + " degree " + std::to_string(known.at("degree").get<int>()));
      const int degree = known.at("degree");
      const auto wanted = known.at("coef_monomial_ascending").get<std::vector<double>>();
      const auto c = fitPolynomial(f, rho, degree);
      ASSERT_EQ(c.size(), wanted.size());
      double scale = 0.0;
      for (const double w : wanted) scale = std::max(scale, std::abs(w));
      for (std::size_t k = 0; k < c.size(); ++k) EXPECT_NEAR(c[k], wanted[k], 1e-7 * scale);
      std::vector<double> fitted;
      for (const double x : f) fitted.push_back(evaluateAt(c, x));
      EXPECT_NEAR(similarity(fitted, rho), known.at("similarity_S").get<double>(), 1e-12);
      EXPECT_NEAR(pearson(fitted, rho), known.at("pearson").get<double>(), 1e-9);
      const double residual = rms(c, f, rho);
      EXPECT_NEAR(aicc(residual * residual, degree, 14).value(), known.at("aicc_neff14").get<double>(), 1e-6);
      EXPECT_EQ(isMonotonePolynomial(c), known.at("lsq_monotone").get<bool>());
      const bool rising = rho.back() > rho.front();
      const auto monotone = fitMonotonePolynomial(f, rho, degree, rising);
      ASSERT_FALSE(monotone.empty());
      EXPECT_TRUE(isMonotonePolynomial(monotone));
      const double gridRms = known.at("monotone_grid_rms");
      EXPECT_NEAR(rms(monotone, f, rho), gridRms, 1e-4 * gridRms);
      const double bernsteinRms = known.at("monotone_bernstein_rms");
      EXPECT_NEAR(rms(fitMonotoneBernstein(f, rho, degree, rising), f, rho), bernsteinRms, 1e-4 * bernsteinRms);
    }
  }
}

TEST(TargetProfiles, MonotoneProfileOfPositiveDataStaysPositive) {
  std::vector<double> f, y;
  for (int i = 0; i <= 100; ++i) {
    f.push_back(i / 100.0);
    y.push_back(std::exp(-12.0 * i / 100.0) + 1e-3);
  }
  for (int degree = 1; degree <= 6; ++degree) {
    const auto c = fitMonotonePolynomial(f, y, degree, false);
    ASSERT_FALSE(c.empty());
    for (const double x : f) EXPECT_GT(evaluateAt(c, x), 0.0);
  }
}

TEST(TargetProfiles, PeriodicProfileMeetsItselfWithItsSlope) {
  std::vector<double> f, y;
  for (int i = 0; i <= 120; ++i) {
    f.push_back(i / 120.0);
    y.push_back(2.0 + std::sin(2.0 * std::numbers::pi * i / 120.0));
  }
  for (int degree = 1; degree <= 6; ++degree) {
    const auto c = fitPeriodicPolynomial(f, y, degree);
    double slope0 = c.size() > 1 ? c[1] : 0.0, slope1 = 0.0;
    for (std::size_t k = 1; k < c.size(); ++k) slope1 += static_cast<double>(k) * c[k];
    EXPECT_NEAR(evaluateAt(c, 0.0), evaluateAt(c, 1.0), 1e-10);
    EXPECT_NEAR(slope0, slope1, 1e-9);
  }
  EXPECT_LT(rms(fitPeriodicPolynomial(f, y, 6), f, y), 0.05);
}

TEST(TargetProfiles, TakesTheLowestDegreeOnACircleAndTheExactOneOnAnExactProfile) {
  const TargetSet circle = fitTargets(test::arc(50.0, 1.5, 20), {});
  EXPECT_EQ(circle.recommendedDegree, 1);
  for (const TargetProfile& p : circle.profiles) {
    ASSERT_TRUE(p.valid);
    EXPECT_NEAR(p.curvatureAt(0.3), 0.02, 1e-5);
    EXPECT_NEAR(p.similarity, 1.0, 1e-6);
  }
}

TEST(TargetProfiles, RefusesRadiusProfilesThroughInflections) {
  TargetParams params;
  params.quantity = TargetQuantity::Radius;
  const TargetSet set = fitTargets(test::wave(200.0, 10.0, 30), params);
  EXPECT_FALSE(set.recommendedDegree);
  for (const TargetProfile& p : set.profiles) {
    EXPECT_FALSE(p.valid);
    EXPECT_FALSE(p.problem.empty());
  }
}

TEST(TargetProfiles, SimilarityRisesWithTheDegreeOfThePlainFit) {
  TargetParams params;
  params.monotone = false;
  params.quantity = TargetQuantity::Radius;
  const TargetSet set = fitTargets(test::ellipseQuarter(200.0, 120.0, 20), params);
  for (std::size_t i = 1; i < set.profiles.size(); ++i) {
    EXPECT_GE(set.profiles[i].similarity, set.profiles[i - 1].similarity - 1e-9);
  }
}

}  // namespace
}  // namespace batten
