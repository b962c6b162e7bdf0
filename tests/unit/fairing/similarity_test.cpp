// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/similarity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace batten {
namespace {

TEST(Similarity, IsOneForProportionalProfilesAndLessForOthers) {
  const std::vector<double> a{1, 2, 3, 4}, b{10, 20, 30, 40}, c{4, 3, 2, 1};
  EXPECT_NEAR(similarity(a, b), 1.0, 1e-15);
  EXPECT_NEAR(similarity(a, c), 20.0 / 30.0, 1e-15);
  EXPECT_NEAR(pearson(a, b), 1.0, 1e-15);
  EXPECT_NEAR(pearson(a, c), -1.0, 1e-15);
}

TEST(Similarity, IsZeroWhereNothingCanBeCompared) {
  const std::vector<double> zero(5, 0.0), constant(5, 0.1), a{1, 2, 3, 4, 5};
  EXPECT_EQ(similarity(zero, a), 0.0);
  EXPECT_EQ(pearson(constant, a), 0.0);
  EXPECT_EQ(pearson(a, constant), 0.0);
  EXPECT_EQ(similarity({}, {}), 0.0);
}

TEST(Similarity, DoesNotOverflow) {
  const std::vector<double> a(3, 1e200), b(3, -1e-200);
  EXPECT_NEAR(similarity(a, b), -1.0, 1e-15);
}

TEST(Aicc, FollowsItsFormulaAndRefusesTooFewSamples) {
  EXPECT_NEAR(aicc(std::exp(2.0), 1, 14).value(), 14 * 2.0 + 6.0 + 24.0 / 10.0, 1e-12);
  EXPECT_FALSE(aicc(1.0, 6, 9)) << "as many unknowns as samples";
  EXPECT_TRUE(std::isfinite(aicc(0.0, 1, 14).value()));
}

}  // namespace
}  // namespace batten
