// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/log_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/known_answers.h"

namespace batten {
namespace {

TEST(LogTransform, MatchesKnownAnswer) {
  const auto data = test::knownAnswer(BATTEN_TEST_DATA, "12_log.json");
  for (std::size_t i = 0; i < data.at("x").size(); ++i) {
    EXPECT_NEAR(logTone(data.at("x")[i], {}), data.at("y")[i].get<double>(), 1e-9);
  }
}

TEST(LogTransform, InverseReturnsTheGreyThatWasNotClipped) {
  for (const double factor : {10.0, kNeutralLogFactor, 80.0}) {
    const LogParams params{true, factor};
    for (double grey = 0.0; grey <= 255.0; grey += 0.5) {
      const double tone = logTone(grey, params);
      if (tone >= 255.0) continue;
      EXPECT_NEAR(greyOfTone(tone, params), grey, 1e-9);
    }
  }
}

TEST(LogTransform, OffShowsTheScan) {
  const auto table = toneTable({.enabled = false});
  for (int i = 0; i < 256; ++i) EXPECT_EQ(table[i], i);
}

TEST(LogTransform, RefusesFactorsOutOfRange) {
  EXPECT_FALSE(validate(LogParams{}).has_value());
  EXPECT_TRUE(validate(LogParams{true, 9.9}).has_value());
  EXPECT_TRUE(validate(LogParams{true, std::nan("")}).has_value());
}

}  // namespace
}  // namespace batten
