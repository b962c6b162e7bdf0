// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/stage_cache.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "core/pipeline/recipe/stage_id.h"

namespace batten {
namespace {

ContentHash key(int i) { return HashBuilder().integer(i).finish(); }
std::shared_ptr<const int> value(int i) { return std::make_shared<const int>(i); }

TEST(StageCache, GivesBackWhatWasStored) {
  StageCache cache(100);
  EXPECT_EQ(cache.find<int>(key(1)), nullptr);
  cache.store(key(1), value(11), 40);
  ASSERT_NE(cache.find<int>(key(1)), nullptr);
  EXPECT_EQ(*cache.find<int>(key(1)), 11);
  EXPECT_EQ(cache.bytesUsed(), 40u);
  cache.store(key(1), value(12), 10);
  EXPECT_EQ(*cache.find<int>(key(1)), 12);
  EXPECT_EQ(cache.bytesUsed(), 10u);
}

TEST(StageCache, HandsOverWhatItHoldsAndKeepsWhatComesAfter) {
  StageCache cache(100);
  cache.store(key(1), value(11), 40);
  cache.store(key(2), value(12), 40);
  auto released = cache.release();
  EXPECT_EQ(released.size(), 2u);
  EXPECT_EQ(cache.find<int>(key(1)), nullptr);
  EXPECT_EQ(cache.bytesUsed(), 0u);
  cache.store(key(3), value(13), 100);
  released.clear();
  ASSERT_NE(cache.find<int>(key(3)), nullptr);
  EXPECT_EQ(cache.bytesUsed(), 100u);
}

TEST(StageCache, DropsTheLeastRecentlyUsed) {
  StageCache cache(100);
  for (int i = 0; i < 3; ++i) cache.store(key(i), value(i), 33);
  EXPECT_NE(cache.find<int>(key(0)), nullptr);  // now 1 is the oldest
  cache.store(key(3), value(3), 33);
  EXPECT_EQ(cache.find<int>(key(1)), nullptr);
  EXPECT_NE(cache.find<int>(key(0)), nullptr);
  EXPECT_NE(cache.find<int>(key(2)), nullptr);
  EXPECT_LE(cache.bytesUsed(), 100u);
}

TEST(StageCache, DoesNotKeepWhatIsLargerThanItsLimit) {
  StageCache cache(100);
  cache.store(key(1), value(1), 60);
  cache.store(key(2), value(2), 101);
  EXPECT_EQ(cache.find<int>(key(2)), nullptr);
  EXPECT_NE(cache.find<int>(key(1)), nullptr);
}

TEST(StageCache, ALowerLimitDropsTheOldest) {
  StageCache cache(100);
  for (int i = 0; i < 3; ++i) cache.store(key(i), value(i), 33);
  EXPECT_NE(cache.find<int>(key(0)), nullptr);  // now 1 is the oldest
  cache.setLimit(66);
  EXPECT_EQ(cache.find<int>(key(1)), nullptr);
  EXPECT_NE(cache.find<int>(key(0)), nullptr);
  EXPECT_NE(cache.find<int>(key(2)), nullptr);
  EXPECT_EQ(cache.bytesUsed(), 66u);
  cache.setLimit(10);
  EXPECT_EQ(cache.bytesUsed(), 0u);
  cache.setLimit(40);
  cache.store(key(4), value(4), 40);
  EXPECT_NE(cache.find<int>(key(4)), nullptr);
}

TEST(StageCache, ServesManyThreads) {
  StageCache cache(500);
  std::vector<std::jthread> threads;
  std::atomic<int> wrong{0};
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 500; ++i) {
        const int k = (i * 7 + t) % 20;
        if (const auto found = cache.find<int>(key(k)); found && *found != k) ++wrong;
        cache.store(key(k), value(k), 50);
      }
    });
  }
  threads.clear();
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(cache.bytesUsed(), 500u);
}

TEST(StageId, NamesReadBack) {
  for (const StageId stage : kStages) EXPECT_EQ(stageFromName(name(stage)), stage);
  EXPECT_EQ(stageFromName("nothing"), std::nullopt);
}

}  // namespace
}  // namespace batten
