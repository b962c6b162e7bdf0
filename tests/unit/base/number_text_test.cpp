// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>

namespace batten {
namespace {

/// A locale that writes 3,5 if the machine has one.
class WithComma {
 public:
  WithComma() : before_(std::setlocale(LC_ALL, nullptr)) {
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8", "nl_NL.UTF-8"})
      if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  ~WithComma() { std::setlocale(LC_ALL, before_.c_str()); }

 private:
  std::string before_;
};

TEST(NumberText, RoundsForMessages) {
  const WithComma locale;
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
  const WithComma locale;
  EXPECT_EQ(significantText(9.3612, 3), "9.36");
  EXPECT_EQ(significantText(0.00123456, 3), "0.00123");
  EXPECT_EQ(significantText(1234.6, 3), "1235");
  EXPECT_EQ(significantText(0.5, 3), "0.5");
  EXPECT_EQ(significantText(0.0, 3), "0");
}

}  // namespace
}  // namespace batten
