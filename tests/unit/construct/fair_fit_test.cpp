// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair_fit.h"

#include <gtest/gtest.h>

#include "fair_shapes.h"
#include "tests/support/known_answers.h"

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
