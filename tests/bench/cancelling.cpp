// SPDX-License-Identifier: GPL-3.0-or-later
// How long a run goes on after it was cancelled: a page of one line with thousands of bends that is not cut at any
// corner, cancelled at many moments spread over each of its long stages.
//
//   bench_cancelling [MOMENTS] [limit=SECONDS] [page=1|2|3] [stage=NAME] [stage.parameter=value …]
//
// MOMENTS per stage, 40 unless told otherwise. A stage that takes longer than the limit (processor time, 20 s unless
// told otherwise) is not run to its end: its moments are spread over the limit, and its row says so. The fairing of
// the long lines is such a stage; the page of one row is there to reach its end too.
// Only one page, or one stage, is measured where it is named.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/platform_memory.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/dense_page.h"

using namespace batten;

namespace {

constexpr int kPagePx = 1000;
constexpr double kMarginPx = 60.0, kStrokePx = 3.0;
constexpr int kMomentsUsual = 40;
constexpr double kLimitUsualMs = 20'000.0;
constexpr auto kBetweenLooks = std::chrono::milliseconds(1);

struct Page {
  const char* name;
  double rowPx, wavePx, heightPx;
  int rows;  ///< At most.
};
constexpr Page kPages[] = {{"soft bends", 40.0, 60.0, 8.0, kPagePx},
                           {"sharp bends", 32.0, 24.0, 9.0, kPagePx},
                           {"one row of sharp bends", 32.0, 24.0, 9.0, 1}};

/// Rows of waves, one behind the other: one line.
std::vector<Vec2> wave(const Page& page, std::uint32_t seed) {
  const auto& [name, rowPx, wavePx, heightPx, rows] = page;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.6, 1.0);
  const double left = kMarginPx, right = kPagePx - kMarginPx;
  std::vector<Vec2> line;
  bool forward = true;
  int row = 0;
  for (double y = kMarginPx; row < rows && y + rowPx < kPagePx - kMarginPx; y += rowPx, forward = !forward, ++row) {
    double height = heightPx * share(random);
    for (double x = left; x <= right; x += 1.0) {
      const double phase = 2.0 * std::numbers::pi * (x - left) / wavePx;
      if (std::abs(std::sin(phase)) < std::numbers::pi / wavePx) height = heightPx * share(random);
      line.emplace_back(forward ? x : left + right - x, y + height * std::sin(phase));
    }
    const double turn = 0.5 * rowPx;
    for (double angle = 0.0; angle < std::numbers::pi; angle += 1.0 / turn) {
      const double out = turn * std::sin(angle);
      line.emplace_back(forward ? right + out : left - out, y + turn - turn * std::cos(angle));
    }
  }
  return line;
}

double wallMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Cancelled {
  double cpuMs = 0.0, wallMs = 0.0;  ///< From the cancel to the return.
};

/// Cancels a run once a stage has had some processor time.
class Watch {
 public:
  explicit Watch(const CancelToken& token) : token_(token) {}
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() { stop(); }

  /// A stage begins now.
  void start(double mostMs) {
    stop();
    ended_ = false;
    thread_ = std::thread([this, mostMs, from = cpuNowMs()] {
      while (!ended_ && cpuNowMs() - from < mostMs) std::this_thread::sleep_for(kBetweenLooks);
      if (ended_) return;
      cancelled_ = {cpuNowMs(), wallMs()};
      token_.cancel();
    });
  }
  void stop() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  static double cpuNowMs() { return 1000.0 * processorSeconds(); }
  /// When it cancelled. @pre stopped.
  const std::optional<Cancelled>& cancelledAt() const { return cancelled_; }

 private:
  CancelToken token_;
  std::atomic<bool> ended_ = true;
  std::optional<Cancelled> cancelled_;
  std::thread thread_;
};

class CancelledRuns {
 public:
  CancelledRuns(Scan scan, Recipe recipe, double limitMs) : scan_(std::move(scan)), recipe_(std::move(recipe)) {
    StageCache cache;
    const RunContext context = oneThread();
    Watch watch(context.cancel);
    double begin = Watch::cpuNowMs();
    PipelineRequest request;
    request.needEdges = false;
    request.stageReady = [&](StageId stage, const PipelineOutput& out) {
      const double now = Watch::cpuNowMs();
      stages_[indexOf(stage)] = {now - begin, true};
      begin = now;
      if (stage == StageId::Curves)
        for (const TracedCurve& c : out.constructed->curves) extrema_ += c.sketchedFigures.extrema;
      watch.start(limitMs);
    };
    const PipelineOutput out = runPipeline(scan_, recipe_, cache, request, context);
    watch.stop();
    if (watch.cancelledAt()) {
      for (StageTime& stage : stages_)
        if (!stage.isWhole) stage.ms = limitMs;
    } else if (out.error) {
      std::printf("%s\n", out.error->message.c_str());
    }
    if (out.pieces) pieces_ = static_cast<int>(out.pieces->pieces.size());
  }

  struct StageTime {
    double ms = 0.0;       ///< Processor time of the stage; of one that was not run to its end, the limit.
    bool isWhole = false;  ///< Run to its end.
  };
  const StageTime& stage(StageId id) const { return stages_[indexOf(id)]; }
  int pieces() const { return pieces_; }
  int extrema() const { return extrema_; }

  /// Cancelled when `afterMs` of processor time have gone into the stage.
  std::optional<Cancelled> cancelled(StageId stage, StageId before, double afterMs) {
    PipelineRequest request;
    request.needEdges = false;
    const RunContext context = oneThread();
    Watch watch(context.cancel);
    request.upTo = stage;
    request.stageReady = [&](StageId ready, const PipelineOutput&) {
      if (ready == before) watch.start(afterMs);
    };
    const PipelineOutput out = runPipeline(scan_, recipe_, cache_, request, context);
    const double cpuEnd = Watch::cpuNowMs(), wallEnd = wallMs();
    watch.stop();
    if (!out.error || !watch.cancelledAt()) return std::nullopt;
    return Cancelled{cpuEnd - watch.cancelledAt()->cpuMs, wallEnd - watch.cancelledAt()->wallMs};
  }

 private:
  static RunContext oneThread() {
    RunContext context;
    context.threads = 1;
    return context;
  }
  Scan scan_;
  Recipe recipe_;
  StageCache cache_;
  std::array<StageTime, kStages.size()> stages_{};
  int pieces_ = 0, extrema_ = 0;
};

std::string timeText(const CancelledRuns::StageTime& time) {
  char text[32];
  std::snprintf(text, sizeof text, "%s%.0f", time.isWhole ? "" : "over ", time.ms);
  return text;
}

struct Asked {
  int moments = kMomentsUsual;
  double limitMs = kLimitUsualMs;
  int page = 0;       ///< From 1; 0: all.
  std::string stage;  ///< Empty: all.
};

void measure(const Page& page, const Recipe& recipe, const Asked& asked) {
  const auto cover = test::coverageOf({wave(page, 1)}, kStrokePx, kPagePx, kPagePx);
  CancelledRuns runs(test::scanOfLines(cover, kPagePx, kPagePx, 1), recipe, asked.limitMs);
  std::printf("\n%s: %d pieces, %d extrema of curvature\n", page.name, runs.pieces(), runs.extrema());
  std::printf("%-12s %12s %9s %16s %16s\n", "stage", "stage CPU ms", "moments", "longest CPU ms", "longest wall ms");
  for (std::size_t i = 1; i < kStages.size(); ++i) {
    const StageId stage = kStages[i], before = kStages[i - 1] == StageId::Edges ? StageId::Filtered : kStages[i - 1];
    if (stage < StageId::Contours || (!asked.stage.empty() && asked.stage != name(stage))) continue;
    const CancelledRuns::StageTime& time = runs.stage(stage);
    Cancelled longest;
    int heard = 0;
    for (int k = 0; k < asked.moments; ++k) {
      const auto one = runs.cancelled(stage, before, time.ms * (k + 0.5) / asked.moments);
      if (!one) continue;
      ++heard;
      longest.cpuMs = std::max(longest.cpuMs, one->cpuMs);
      longest.wallMs = std::max(longest.wallMs, one->wallMs);
    }
    std::printf("%-12s %12s %9d %16.1f %16.1f\n", std::string(name(stage)).c_str(), timeText(time).c_str(), heard,
                longest.cpuMs, longest.wallMs);
    std::fflush(stdout);
    if (!time.isWhole) break;
  }
}

}  // namespace

int main(int argc, char** argv) {
  Recipe recipe;
  recipe.corners.automatic = false;
  recipe.preparation.rulings = RulingUse::Keep;
  recipe.fairing.mode = FairingMode::Tolerance;
  Asked asked;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    const std::string before = word.substr(0, equals);
    const std::string after = equals == std::string::npos ? std::string() : word.substr(equals + 1);
    if (equals == std::string::npos) {
      asked.moments = std::max(1, std::atoi(word.c_str()));
    } else if (before == "limit") {
      asked.limitMs = 1000.0 * std::max(0.1, std::atof(after.c_str()));
    } else if (before == "page") {
      asked.page = std::atoi(after.c_str());
    } else if (before == "stage") {
      asked.stage = after;
    } else if (const auto done = setParameter(recipe, before, after); !done) {
      std::fprintf(stderr, "%s\n", done.error().message.c_str());
      return 2;
    }
  }
  int number = 0;
  for (const Page& page : kPages)
    if (++number == asked.page || asked.page == 0) measure(page, recipe, asked);
  return 0;
}
