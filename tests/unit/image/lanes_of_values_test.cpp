// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/lanes_of_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace batten;

namespace {

// Every lane against sorting it by itself; few different values, so that many are equal.
TEST(LanesOfValues, FindsTheValueOfARankInEveryLane) {
  std::mt19937 random(3);
  for (const int lanes : {1, 7, 16, 100}) {
    for (const int count : {1, 2, 9, 25, 49}) {
      for (const int rank : {0, count / 2, count - 1}) {
        std::vector<std::vector<int>> plain(lanes);
        LanesOfValues values(lanes);
        for (int k = 0; k < count; ++k) {
          std::int16_t* to = values.add();
          for (int i = 0; i < lanes; ++i) {
            const int value = i % 2 == 0 ? static_cast<int>(random() % 65536) : static_cast<int>(random() % 3) * 32767;
            plain[i].push_back(value);
            to[i] = static_cast<std::int16_t>(value - LanesOfValues::kMiddle);
          }
        }
        ASSERT_EQ(values.count(), count);
        const std::vector<std::int16_t> least = values.leastOf();
        values.sortTo(rank);
        for (int i = 0; i < lanes; ++i) {
          std::sort(plain[i].begin(), plain[i].end());
          ASSERT_EQ(least[i] + LanesOfValues::kMiddle, plain[i].front()) << lanes << " " << count;
          ASSERT_EQ(values.value(rank, i), plain[i][rank]) << lanes << " " << count << " " << rank;
        }
      }
    }
  }
}

}  // namespace
