// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/large_page_speed.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/base/content_hash.h"
#include "core/base/platform_memory.h"
#include "core/base/statistics.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/large_page.h"

namespace batten::test {
namespace {

constexpr int kPageWidth = 7016, kPageHeight = 4960, kPageStrokes = 72;  // A4 across at 600 dpi
constexpr int kThreads = 2;
constexpr int kMultiplyAdds = 10'000'000;

struct Times {
  double cpuMs = 0.0, wallMs = 0.0;
};

Times timesOf(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  const double cpu = processorSeconds();
  work();
  const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return {1000.0 * (processorSeconds() - cpu), wall};
}

struct SpeedRow {
  std::string name;
  std::function<Times()> run;
  std::vector<double> cpu{}, wall{}, copies{};
};

double medianOf(std::vector<double> values) { return upperMedian(values); }

RunContext twoThreads() {
  RunContext context;
  context.threads = kThreads;
  return context;
}

/// As if read from a file, whose hash stands for the pixels: no run has to hash those.
Scan pageOfFile() {
  Scan scan = largePage(kPageWidth, kPageHeight, kPageStrokes, 1);
  scan.fileHash = sha256(std::as_bytes(std::span(scan.grey.pixels)));
  return scan;
}

/// Each stage by itself, on what the one before has made.
struct PageStages {
  Scan scan = pageOfFile();
  Recipe recipe;
  PreparedPage page = *preparePage(scan, recipe.preparation, twoThreads());
  RegionThresholds thresholds = *findThresholds(scan.grey, recipe.paper, recipe.threshold, twoThreads());
  BitImage binary = *binarize(scan.grey, thresholds, recipe.threshold, twoThreads());
  BitImage filtered = neighbourhoodFilter(binary, recipe.filter, twoThreads())->ink;
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(scan.grey.pixels.size(), 1);
};

Times runUpTo(const PageStages& p, StageId last, const std::function<void(Recipe&)>& change) {
  Recipe recipe = p.recipe;
  change(recipe);
  return timesOf([&] {
    StageCache cache(0);
    PipelineRequest request;
    request.upTo = last;
    request.needEdges = false;  // as the command line runs it
    const PipelineOutput out = runPipeline(p.scan, recipe, cache, request, twoThreads());
    if (out.error) std::printf("%s\n", out.error->message.c_str());
  });
}

std::vector<SpeedRow> rowsOf(PageStages& p) {
  const auto plain = [](Recipe&) {};
  const auto dense = [](Recipe& recipe) { recipe.construct.light = false; };
  const auto outlines = [](Recipe& recipe) {
    recipe.edges.mode = EdgeMode::Outline;
    recipe.construct.method = ConstructMethod::Nurbs;
  };
  std::vector<SpeedRow> rows;
  rows.push_back({"copy of the page, 8 bit, one thread", [&p] {
                    std::vector<std::uint8_t> to(p.bytes.size());
                    return timesOf([&] { std::memcpy(to.data(), p.bytes.data(), to.size()); });
                  }});
  rows.push_back({"10 million multiply-adds, each on the last", [] {
                    return timesOf([] {
                      volatile double start = 1.0;
                      double value = start;
                      for (int i = 0; i < kMultiplyAdds; ++i) value = value * 0.999999 + 1e-6;
                      start = value;
                    });
                  }});
  rows.push_back({"preparation: sheet and rulings",
                  [&p] { return timesOf([&] { (void)preparePage(p.scan, p.recipe.preparation, twoThreads()); }); }});
  rows.push_back({"thresholds", [&p] {
                    return timesOf(
                        [&] { (void)findThresholds(p.scan.grey, p.recipe.paper, p.recipe.threshold, twoThreads()); });
                  }});
  rows.push_back(
      {"binary",
       [&p] { return timesOf([&] { (void)binarize(p.scan.grey, p.thresholds, p.recipe.threshold, twoThreads()); }); }});
  rows.push_back({"neighbourhood filter", [&p] {
                    return timesOf([&] { (void)neighbourhoodFilter(p.binary, p.recipe.filter, twoThreads()); });
                  }});
  rows.push_back({"skeleton", [&p] {
                    return timesOf([&] {
                      BitImage ink = p.filtered;
                      thinToSkeleton(ink, twoThreads());
                    });
                  }});
  rows.push_back({"grey to filtered ink", [&p, plain] { return runUpTo(p, StageId::Filtered, plain); }});
  rows.push_back({"grey to lines", [&p, plain] { return runUpTo(p, StageId::Contours, plain); }});
  rows.push_back({"grey to curves, dense", [&p, dense] { return runUpTo(p, StageId::Faired, dense); }});
  rows.push_back({"grey to curves, light", [&p, plain] { return runUpTo(p, StageId::Faired, plain); }});
  rows.push_back(
      {"grey to outlines as quintic NURBS", [&p, outlines] { return runUpTo(p, StageId::Faired, outlines); }});
  return rows;
}

/// Programs beside this one are timed by the clock: their processor time is not ours to read.
void addPeers(std::vector<SpeedRow>& rows, const Scan& scan, const std::filesystem::path& folder) {
  const auto runs = [](const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; };
  if (!runs("potrace --version") || !runs("mkbitmap --version")) return;
  const std::string pgm = (folder / "page.pgm").string(), pbm = (folder / "page.pbm").string();
  std::ofstream out(pgm, std::ios::binary);
  out << "P5\n" << scan.grey.width << ' ' << scan.grey.height << "\n255\n";
  for (const std::uint16_t v : scan.grey.pixels) out.put(static_cast<char>(v / 257));
  out.close();
  const auto timed = [runs](const std::string& command) { return timesOf([&] { runs(command); }); };
  const std::string make = "mkbitmap -s 1 -o " + pbm + " " + pgm, trace = "potrace -b svg -o /dev/null " + pbm;
  rows.push_back({"mkbitmap and potrace, by the clock", [=] { return timed(make + " && " + trace); }});
  rows.push_back({"potrace alone, by the clock", [=] { return timed(trace); }});
}

}  // namespace

void printLargePageSpeed(int rounds) {
  PageStages stages;
  std::vector<SpeedRow> rows = rowsOf(stages);
  const auto folder =
      std::filesystem::temp_directory_path() / ("batten-speed-" + std::to_string(std::random_device()()));
  std::filesystem::create_directories(folder);
  addPeers(rows, stages.scan, folder);
  for (int round = -1; round < rounds; ++round) {
    double copyMs = 1.0;
    for (SpeedRow& row : rows) {
      const Times times = row.run();
      if (&row == rows.data()) copyMs = std::max(1e-3, times.cpuMs);
      if (round < 0) continue;  // the first one only wakes everything up
      row.cpu.push_back(times.cpuMs);
      row.wall.push_back(times.wallMs);
      row.copies.push_back(times.cpuMs / copyMs);
    }
  }
  std::filesystem::remove_all(folder);
  std::printf("%d x %d px, %d strokes, %d threads, %d rounds\n", kPageWidth, kPageHeight, kPageStrokes, kThreads,
              rounds);
  std::printf("%-44s %21s %12s %21s\n", "", "processor ms", "page copies", "clock ms");
  std::printf("%-44s %10s %10s %12s %10s %10s\n", "", "least", "median", "median", "least", "median");
  for (const SpeedRow& row : rows) {
    std::printf("%-44s %10.1f %10.1f %12.1f %10.1f %10.1f\n", row.name.c_str(),
                *std::min_element(row.cpu.begin(), row.cpu.end()), medianOf(row.cpu), medianOf(row.copies),
                *std::min_element(row.wall.begin(), row.wall.end()), medianOf(row.wall));
  }
}

}  // namespace batten::test
