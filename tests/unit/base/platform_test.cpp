// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/platform.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <vector>

namespace batten {
namespace {

constexpr std::size_t kBlock = std::size_t{64} << 20;

TEST(Platform, MemoryThatIsTakenIsSeen) {
  const std::uint64_t before = residentMemoryBytes(getpid());
  ASSERT_GT(before, 0u);
  std::vector<char> block(kBlock);
  std::memset(block.data(), 1, block.size());
  EXPECT_GE(residentMemoryBytes(getpid()) + (kBlock / 8), before + kBlock);
  EXPECT_GE(peakMemoryBytes() + (kBlock / 8), before + kBlock);
  EXPECT_EQ(residentMemoryBytes(-1), 0u);
}

TEST(Platform, AProcessIsKnownByItsNumber) {
  EXPECT_TRUE(isProcessRunning(getpid()));
  EXPECT_TRUE(isProcessRunning(1));  // of somebody else, perhaps
  const pid_t child = fork();
  if (child == 0) _exit(0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_FALSE(isProcessRunning(child));
  EXPECT_FALSE(isProcessRunning(0));
  EXPECT_FALSE(isProcessRunning(-1));
}

TEST(Platform, NoMoreMemoryIsFreeThanThereIs) {
  std::ifstream in("/proc/meminfo");
  std::string key;
  std::uint64_t kilobytes = 0;
  in >> key >> kilobytes;
  ASSERT_EQ(key, "MemTotal:");
  const auto available = availableMemoryBytes();
  ASSERT_TRUE(available);
  EXPECT_GT(*available, 0u);
  EXPECT_LE(*available, kilobytes * 1024);
}

TEST(Platform, WorkTakesProcessorTime) {
  const double before = processorSeconds();
  volatile double sum = 0.0;
  while (processorSeconds() < before + 0.02) {
    for (int i = 0; i < 1000; ++i) sum = sum + i;
  }
  EXPECT_GT(processorSeconds(), before);
}

TEST(Platform, QuietStderrPutsItBack) {
  testing::internal::CaptureStderr();
  {
    const QuietStderr quiet;
    std::fputs("unheard", stderr);
  }
  std::fputs("heard", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "heard");
}

}  // namespace
}  // namespace batten
