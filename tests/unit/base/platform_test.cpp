// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/platform.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/base/loaded_module.h"
#include "core/base/platform_memory.h"

namespace batten {
namespace {

constexpr std::size_t kBlock = std::size_t{64} << 20;

TEST(Platform, MemoryThatIsTakenIsSeen) {
  const std::optional<std::uint64_t> before = residentMemoryBytes(getpid());
  ASSERT_TRUE(before);
  ASSERT_GT(*before, 0u);
  std::vector<char> block(kBlock);
  std::memset(block.data(), 1, block.size());
  EXPECT_GE(residentMemoryBytes(getpid()).value_or(0) + (kBlock / 8), *before + kBlock);
  EXPECT_GE(peakMemoryBytes().value_or(0) + (kBlock / 8), *before + kBlock);
  EXPECT_FALSE(residentMemoryBytes(-1));
}

TEST(Platform, ABufferKeepsWhatIsWrittenToIt) {
  constexpr std::size_t kMegabyte = std::size_t{1} << 20;
  for (const std::size_t bytes :
       {std::size_t{0}, std::size_t{1}, std::size_t{4097}, 4 * kMegabyte - 1, 4 * kMegabyte, 9 * kMegabyte + 3}) {
    // One more than is compared: an empty vector has no data, and memcmp() takes no null pointer.
    const std::vector<unsigned char> ones(bytes + 1, 1), twos(bytes + 1, 2);
    void *const first = allocateBuffer(bytes), *const second = allocateBuffer(bytes);
    ASSERT_NE(first, nullptr);
    ASSERT_NE(second, nullptr);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first) % alignof(std::max_align_t), 0u);
    std::memset(first, 1, bytes);
    std::memset(second, 2, bytes);
    EXPECT_EQ(std::memcmp(first, ones.data(), bytes), 0) << bytes;
    EXPECT_EQ(std::memcmp(second, twos.data(), bytes), 0) << bytes;
    freeBuffer(first);
    freeBuffer(second);
  }
  EXPECT_EQ(allocateBuffer(std::numeric_limits<std::size_t>::max()), nullptr);
}

TEST(Platform, AProcessIsKnownByItsMark) {
  const std::string own = processMark(getpid());
  EXPECT_EQ(own.find(std::to_string(getpid()) + " "), 0u) << own;
  EXPECT_EQ(processMark(getpid()), own);
  EXPECT_FALSE(processMark(1).empty());  // of somebody else, perhaps
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t info{};
  ASSERT_EQ(waitid(P_PID, child, &info, WEXITED | WNOWAIT), 0);
  EXPECT_EQ(processMark(child), "") << "it has ended, though nobody has asked how";
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(processMark(child), "");
  EXPECT_EQ(processMark(0), "");
  EXPECT_EQ(processMark(-1), "");
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
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer writes its report there: nothing is silenced";
#endif
  testing::internal::CaptureStderr();
  {
    const QuietStderr quiet;
    std::fputs("unheard", stderr);
  }
  std::fputs("heard", stderr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "heard");
}

class SharedFiles : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("batten-shared-" + std::to_string(getpid()));
};

TEST_F(SharedFiles, LinesOfManyProgramsStayWhole) {
  constexpr int kPrograms = 4, kLines = 50;
  const std::filesystem::path file = folder_ / "lines";
  std::ofstream(file) << "cut of";
  std::vector<pid_t> children;
  for (int i = 0; i < kPrograms; ++i) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    auto lines = SharedLines::open(file);
    std::string text(2000, static_cast<char>('a' + i));
    text.push_back('\n');
    for (int k = 0; k < kLines; ++k) (void)lines->add(text);
    _exit(0);
  }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "cut of") << "it was ended, not written on";
  int count = 0;
  for (; std::getline(in, line); ++count) EXPECT_EQ(line, std::string(2000, line.front()));
  EXPECT_EQ(count, kPrograms * kLines);
  const auto lines = SharedLines::open(file);
  EXPECT_EQ(lines->size(), 7u + kPrograms * kLines * 2001u);
  EXPECT_EQ(lines->read(0, 7).value(), "cut of\n");
  EXPECT_EQ(lines->read(lines->size(), 7).value(), "");
  EXPECT_FALSE(SharedLines::open(folder_ / "none" / "lines"));
  EXPECT_EQ(SharedLines::open("/dev/null")->add("x\n"), std::error_code());
  EXPECT_EQ(SharedLines::open("/dev/full")->add("x\n"), std::errc::no_space_on_device);
}

TEST_F(SharedFiles, ALockTellsBusyFromImpossible) {
  LockFile first(folder_ / "lock"), second(folder_ / "lock"), nowhere(folder_ / "none" / "lock");
  EXPECT_EQ(first.tryHold(), LockState::Held);
  EXPECT_EQ(first.tryHold(), LockState::Held);
  EXPECT_EQ(second.tryHold(), LockState::Busy);
  EXPECT_EQ(nowhere.tryHold(), LockState::Impossible);
}

TEST_F(SharedFiles, AFileIsItselfByAnyName) {
  std::ofstream(folder_ / "a") << "x";
  std::ofstream(folder_ / "b") << "x";
  std::filesystem::create_symlink("a", folder_ / "soft");
  std::filesystem::create_hard_link(folder_ / "a", folder_ / "hard");
  EXPECT_TRUE(fileId(folder_ / "a"));
  EXPECT_EQ(fileId(folder_ / "a"), fileId(folder_ / "soft"));
  EXPECT_EQ(fileId(folder_ / "a"), fileId(folder_ / "hard"));
  EXPECT_NE(fileId(folder_ / "a"), fileId(folder_ / "b"));
  EXPECT_FALSE(fileId(folder_ / "none"));
}

TEST(Platform, AModuleThatIsMissingHasNoFunction) { EXPECT_EQ(functionOfModule("batten-none", "any"), nullptr); }

}  // namespace
}  // namespace batten
