// SPDX-License-Identifier: GPL-3.0-or-later
// A batch on a system that starts no process: each page is traced in the program itself.
#include "tests/cli/batch_program.h"

namespace batten {
namespace {

using namespace test;

constexpr double kTracedSeconds = 0.3;  // of the processors: the page is being traced, and far from its end

class BatchInProcess : public Batch {
 protected:
  Outcome runHere(const std::string& words) const {
    const NoProcesses environment;
    return run(words);
  }

  /// The environment in which the program starts no process.
  class NoProcesses {
   public:
    NoProcesses() {
      setenv("BATTEN_NO_PROCESSES", "1", 1);
      setenv("LD_PRELOAD", BATTEN_FEW_PROCESSES, 1);
    }
    ~NoProcesses() {
      unsetenv("BATTEN_NO_PROCESSES");
      unsetenv("LD_PRELOAD");
    }
    NoProcesses(const NoProcesses&) = delete;
    NoProcesses& operator=(const NoProcesses&) = delete;
  };

  /// Rows of shapes as NAME.png: each takes its time.
  void drawRows(const std::string& name, int rows) const {
    const auto truth = truthShape("car", 480, 320);
    const Scan one = renderPage(fillCoverage(truth.outline(), 480, 320), 480, 320, scannedPage(3));
    GreyImage page(480 * rows, 320 * rows, 65535);
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x) page.row(y)[x] = one.grey.row(y % 320)[x % 480];
    }
    write(name + ".png", pngOf(page));
  }
};

TEST_F(BatchInProcess, APrintedReportIsRefusedHoweverItsEndingIsWritten) {
  drawPage("a");
  for (const char* ending : {"report.pdf", "report.PDF"}) {
    const auto done = runHere("batch " + file("a.png") + " --to " + file("out") + " --formats svg," + ending);
    EXPECT_EQ(done.code, 6) << done.err;
    EXPECT_NE(done.out.find("leave these out"), std::string::npos) << done.out << done.err;
  }
}

TEST_F(BatchInProcess, TimeIsThatOfThePageAndThePeakOfAllPagesIsNotTold) {
  std::string pages;
  for (const char* name : {"a", "b", "c"}) {
    drawPage(name, "car");
    pages += line(name);
  }
  write("pages.jsonl", pages);
  const auto done = runHere("batch " + file("pages.jsonl") + " --jobs 1 --sheet " + file("sheet.html"));
  ASSERT_EQ(done.code, 0) << done.err;
  const auto lines = linesOf(done.out);
  ASSERT_EQ(lines.size(), 3u);
  const auto took = [&](int page) { return lines[page]["processor_milliseconds"].get<double>(); };
  EXPECT_GT(took(2), 0.0);
  EXPECT_LT(took(2), took(0) + took(1)) << "the pages are alike";
  for (const json& one : lines) EXPECT_FALSE(one.contains("peak_memory_bytes")) << one;
  EXPECT_EQ(readFile(file("sheet.html")).find(" MB"), std::string::npos);
}

TEST_F(BatchInProcess, ASecondSignalEndsTheRunningPage) {
  drawRows("a", 8);
  write("pages.jsonl", line("a"));
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(file("a.svg.batch.json"));
    const auto program = [&] {
      const NoProcesses environment;
      return Running({"batch", file("pages.jsonl"), "--jobs", "1", "--results", file("r.jsonl")});
    }();
    ASSERT_TRUE(waitUntil([&] { return fs::exists(file("a.svg.batch.json")); }));
    const double begun = program.processorSeconds();
    ASSERT_TRUE(waitUntil([&] { return program.processorSeconds() > begun + kTracedSeconds; }));
    program.send(signal);
    ASSERT_TRUE(waitUntil([&] { return !program.isPending(signal); })) << "two that wait would be one";
    program.send(signal);
    const int status = program.wait();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7) << status;
    EXPECT_EQ(linesIn(file("r.jsonl")), 0) << "the page counts as begun";
    EXPECT_FALSE(fs::exists(file("a.svg")));
    EXPECT_FALSE(fs::exists(file("a.svg.batch.json.lock")));
  }
}

}  // namespace
}  // namespace batten
