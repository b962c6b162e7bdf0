// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/bench/job_figures.h"

namespace batten {
namespace {

TEST(MainJob, EveryFigureIsWithinItsLimit) {
  const auto figures = test::mainJob(1);
  EXPECT_EQ(figures.size(), 26u);
  for (const test::JobFigure& figure : figures)
    EXPECT_LE(figure.value, figure.limit) << figure.scene << ": " << figure.what;
}

}  // namespace
}  // namespace batten
