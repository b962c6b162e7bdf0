// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_fit.h"

#include <gtest/gtest.h>

#include "tests/support/known_answers.h"
#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

class FairKnownAnswer : public testing::TestWithParam<const char*> {};

TEST_P(FairKnownAnswer, FindsTheDrawnExtremaAndLiesOnThePoints) {
  const auto answer = test::knownAnswer(BATTEN_TEST_DATA, GetParam());
  auto points = test::toPoints(answer.at("points"));
  const bool closed = answer.at("closed").get<bool>();
  const auto fit = test::fitOne(points, closed);
  ASSERT_TRUE(fit.has_value()) << fit.error().message;
  const ConstructedPiece& piece = fit->front();
  ASSERT_EQ(piece.curve.degree(), 5);
  const auto found = test::extremaOf(piece.curve, closed);
  const auto& expected = answer.at("expected_extrema");
  EXPECT_EQ(found.size(), expected.size());
  const double tolerance = answer.at("position_tolerance").get<double>();
  for (const auto& e : expected) {
    double nearest = 1.0;
    for (const auto& f : found) {
      double d = std::abs(f.fraction - e.at(0).get<double>());
      if (closed) d = std::min(d, 1.0 - d);
      if (f.type == e.at(1).get<int>()) nearest = std::min(nearest, d);
    }
    EXPECT_LE(nearest, tolerance) << "extremum at " << e.at(0);
  }
  EXPECT_NEAR(piece.report.noisePx.value(), 0.127, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Files, FairKnownAnswer,
                         testing::Values("13_fair_clothoid-monotone.json", "14_fair_nose-next-to-flat-hood.json",
                                         "15_fair_roof-two-bumps.json", "16_fair_ellipse-closed.json",
                                         "17_fair_circle-closed.json", "18_fair_straight-line.json"));

}  // namespace
}  // namespace batten
