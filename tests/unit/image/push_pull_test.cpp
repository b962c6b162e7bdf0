// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/push_pull.h"

#include <gtest/gtest.h>

#include <vector>

namespace batten {
namespace {

TEST(PushPull, KeepsSureCellsAndFillsTheRestWithinTheirRange) {
  std::vector<float> values(21 * 13, 0.0f), weights(values.size(), 0.0f);
  values[5] = 3.0f;
  weights[5] = 1.0f;
  values[200] = 9.0f;
  weights[200] = 1.0f;
  const auto filled = pushPull(values, weights, 21, 13);
  EXPECT_EQ(filled[5], 3.0f);
  EXPECT_EQ(filled[200], 9.0f);
  for (const float v : filled) {
    EXPECT_GE(v, 3.0f - 1e-4f);
    EXPECT_LE(v, 9.0f + 1e-4f);
  }
}

}  // namespace
}  // namespace batten
