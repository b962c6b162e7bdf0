// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "tests/support/comma_locale.h"

namespace batten {
namespace {

/// Fails where the locale does not hold: a test of what is independent of it would then pass whatever is written.
void expectCommas() {
  std::ostringstream commas;
  commas << 1234.5;
  EXPECT_EQ(commas.str(), "1.234,5");
}

TEST(NumberText, RoundsForMessages) {
  const test::CommaLocale locale;
  expectCommas();
  EXPECT_EQ(counted(1, "line was", "lines were"), "1 line was");
  EXPECT_EQ(counted(0, "line was", "lines were"), "0 lines were");
  EXPECT_EQ(roundedText(7.0, 6), "7");
  EXPECT_EQ(roundedText(0.25, 3), "0.25");
  EXPECT_EQ(roundedText(2.0 / 3.0, 2), "0.67");
  EXPECT_EQ(roundedText(-0.001, 2), "0");
  EXPECT_EQ(roundedText(1200.0, 0), "1200");
  EXPECT_EQ(roundedText(1e300, 0).size(), 301u);
  EXPECT_EQ(roundedText(std::nan(""), 2), "no number");
  EXPECT_EQ(roundedText(-std::numeric_limits<double>::infinity(), 2), "-infinity");
}

TEST(NumberText, KeepsTheDigitsThatCount) {
  const test::CommaLocale locale;
  expectCommas();
  EXPECT_EQ(significantText(9.3612, 3), "9.36");
  EXPECT_EQ(significantText(0.00123456, 3), "0.00123");
  EXPECT_EQ(significantText(1234.6, 3), "1235");
  EXPECT_EQ(significantText(0.5, 3), "0.5");
  EXPECT_EQ(significantText(0.0, 3), "0");
}

TEST(NumberText, SaysSharesInPercent) {
  EXPECT_EQ(percentText(0.123), "12");
  EXPECT_EQ(percentText(1.0), "100");
  EXPECT_EQ(percentText(0.0064), "0.6");
  EXPECT_EQ(percentText(0.0004), "less than 0.1");
  EXPECT_EQ(percentText(0.0), "0");
}

TEST(NumberText, WritesAndReadsPointsUnderALocaleWithCommas) {
  const test::CommaLocale locale;
  expectCommas();
  EXPECT_EQ(numberToText(12345.25), "12345.25");
  EXPECT_EQ(numberFromText("12345.25"), 12345.25);
  EXPECT_FALSE(numberFromText("12345,25"));
  EXPECT_EQ(integerFromText("12345"), 12345);
  EXPECT_EQ(counted(12345, "point", "points"), "12345 points");
}

}  // namespace
}  // namespace batten
