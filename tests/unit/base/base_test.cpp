// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/base/content_hash.h"
#include "core/base/page_frame.h"
#include "core/base/parallel.h"

namespace batten {
namespace {

TEST(ContentHash, MatchesThePublishedDigests) {
  EXPECT_EQ(sha256({}).hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const std::string abc = "abc";  // FIPS 180-4, example of one block
  EXPECT_EQ(sha256(std::as_bytes(std::span(abc))).hex(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(ContentHash, NeighboursDoNotRunIntoEachOther) {
  const auto digest = [](std::string_view a, std::string_view b) {
    HashBuilder builder;
    return builder.text(a).text(b).finish();
  };
  EXPECT_NE(digest("ab", "c"), digest("a", "bc"));
  HashBuilder plus, minus;
  EXPECT_EQ(plus.number(0.0).finish(), minus.number(-0.0).finish());
}

TEST(PageFrame, GoesToTheModelAndBack) {
  const PageFrame frame{1000, 800, 25.4 / 300.0};
  const Vec2 corner = frame.pointToModel({0.0, 800.0});
  EXPECT_DOUBLE_EQ(corner.norm(), 0.0);
  EXPECT_GT(frame.pointToModel({0.0, 0.0}).y(), 0.0);
  const Vec2 p{123.4, 567.8};
  EXPECT_LT((frame.pointToImage(frame.pointToModel(p)) - p).norm(), 1e-12 * p.norm());
  const Vec2 moved = frame.pointToModel(p + Vec2{3.0, -5.0}) - frame.pointToModel(p);
  EXPECT_LT((moved - frame.vectorToModel({3.0, -5.0})).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(frame.lengthToImage(frame.lengthToModel(42.0)), 42.0);
}

TEST(ParallelFor, CoversEveryIndexOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 7}) {
    RunContext context;
    context.threads = threads;
    std::vector<int> visits(1003, 0);
    parallelFor(context, 1003, 10, [&](int begin, int end) {
      EXPECT_EQ(begin % 10, 0);
      EXPECT_LE(end - begin, 10);
      for (int i = begin; i < end; ++i) ++visits[i];
    });
    EXPECT_EQ(std::set<int>(visits.begin(), visits.end()), std::set<int>{1});
  }
}

// Ends this process, which may take no more than a few stacks beyond what it has: with 0 if the loop was whole.
[[noreturn, maybe_unused]] void loopWithFewThreads() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{24} << 20);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  RunContext context;
  context.threads = 64;
  std::vector<int> seen(1000, 0);
  parallelFor(context, 1000, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) ++seen[i];
  });
  _exit(seen == std::vector<int>(1000, 1) ? 0 : 1);
}

TEST(ParallelFor, DoesWithoutThreadsThatCannotBeStarted) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these take address space as they please
  constexpr const char* kAskedInChild = "BATTEN_LOOP_WITH_FEW_THREADS";
  if (std::getenv(kAskedInChild) != nullptr) loopWithFewThreads();
  // In a process begun anew: a copy of this one would have the locks of the threads that stay, but not the threads.
  const pid_t child = fork();
  if (child == 0) {
    setenv(kAskedInChild, "1", 1);
    execl("/proc/self/exe", "test_base", "--gtest_filter=ParallelFor.DoesWithoutThreadsThatCannotBeStarted", nullptr);
    _exit(2);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << "ended by a signal";
  EXPECT_EQ(WEXITSTATUS(status), 0);
#endif
}

TEST(ParallelFor, KeepsItsThreads) {
  static std::atomic<int> ended{0};
  struct CountsItsEnd {
    ~CountsItsEnd() { ++ended; }
  };
  RunContext context;
  context.threads = 3;
  std::atomic<int> blocks{0};
  for (int round = 0; round < 50; ++round) {
    parallelFor(context, 6, 1, [&](int, int) {
      static thread_local CountsItsEnd one;
      static_cast<void>(one);
      ++blocks;
      std::this_thread::sleep_for(std::chrono::microseconds(100));  // time for another thread to take a block
    });
  }
  EXPECT_EQ(blocks, 300);
  EXPECT_EQ(ended, 0);
}

TEST(ParallelFor, LoopsInsideLoopsAndOfSeveralThreadsAllEnd) {
  RunContext context;
  context.threads = 4;
  std::atomic<int> sum{0};
  const auto many = [&] {
    for (int round = 0; round < 20; ++round)
      parallelFor(context, 8, 1,
                  [&](int, int) { parallelFor(context, 10, 1, [&](int begin, int end) { sum += end - begin; }); });
  };
  {
    std::vector<std::jthread> callers;
    for (int i = 0; i < 3; ++i) callers.emplace_back(many);
  }
  EXPECT_EQ(sum, 3 * 20 * 8 * 10);
}

TEST(ParallelFor, RethrowsAndHandlesNothingToDo) {
  RunContext context;
  context.threads = 3;
  EXPECT_THROW(parallelFor(context, 100, 1,
                           [](int begin, int) {
                             if (begin == 50) throw std::runtime_error("x");
                           }),
               std::runtime_error);
  bool called = false;
  parallelFor(context, 0, 1, [&](int, int) { called = true; });
  EXPECT_FALSE(called);
}

TEST(CancelToken, CopiesShareTheFlagAndStopTheBlocksNotYetStarted) {
  RunContext context;
  context.threads = 1;
  const CancelToken copy = context.cancel;
  int blocks = 0;
  parallelFor(context, 100, 1, [&](int, int) {
    if (++blocks == 3) copy.cancel();
  });
  EXPECT_TRUE(context.isCancelled());
  EXPECT_EQ(blocks, 3);
}

}  // namespace
}  // namespace batten
