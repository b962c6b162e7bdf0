// SPDX-License-Identifier: GPL-3.0-or-later
// How long a run goes on after it was cancelled: a page of one line with thousands of bends that is not cut at any
// corner, cancelled at many moments spread over each of its long stages.
//
//   bench_cancelling [MOMENTS] [stage.parameter=value …]      MOMENTS per stage, 40 unless told otherwise

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

#include "core/base/platform.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/dense_page.h"

using namespace batten;

namespace {

constexpr int kPagePx = 1000;
constexpr double kMarginPx = 60.0, kStrokePx = 3.0;
constexpr int kMomentsUsual = 40;
constexpr auto kBetweenLooks = std::chrono::milliseconds(1);

/// Rows of waves, one behind the other: one line.
std::vector<Vec2> wave(double rowPx, double wavePx, double heightPx, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.6, 1.0);
  const double left = kMarginPx, right = kPagePx - kMarginPx;
  std::vector<Vec2> line;
  bool forward = true;
  for (double y = kMarginPx; y + rowPx < kPagePx - kMarginPx; y += rowPx, forward = !forward) {
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

struct Page {
  const char* name;
  double rowPx, wavePx, heightPx;
};
constexpr Page kPages[] = {{"soft bends", 40.0, 60.0, 8.0}, {"sharp bends", 32.0, 24.0, 9.0}};

double wallMs() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Cancelled {
  double cpuMs = 0.0, wallMs = 0.0;  ///< From the cancel to the return.
};

class CancelledRuns {
 public:
  CancelledRuns(Scan scan, Recipe recipe) : scan_(std::move(scan)), recipe_(std::move(recipe)) {
    StageCache cache;
    std::vector<double> ready;
    double begin = 1000.0 * processorSeconds();
    PipelineRequest request;
    request.needEdges = false;
    request.stageReady = [&](StageId stage, const PipelineOutput& out) {
      const double now = 1000.0 * processorSeconds();
      stageMs_[indexOf(stage)] = now - begin;
      begin = now;
      if (stage == StageId::Curves)
        for (const TracedCurve& c : out.constructed->curves) extrema_ += c.sketchedFigures.extrema;
    };
    const PipelineOutput out = runPipeline(scan_, recipe_, cache, request, oneThread());
    if (out.error) std::printf("%s\n", out.error->message.c_str());
    if (out.pieces) pieces_ = static_cast<int>(out.pieces->pieces.size());
  }
  double stageMs(StageId stage) const { return stageMs_[indexOf(stage)]; }
  int pieces() const { return pieces_; }
  int extrema() const { return extrema_; }

  /// Cancelled when `afterMs` of processor time have gone into the stage.
  std::optional<Cancelled> cancelled(StageId stage, StageId before, double afterMs) {
    PipelineRequest request;
    request.needEdges = false;
    const RunContext context = oneThread();
    std::thread watch;
    double cpu = 0.0, wall = 0.0;
    std::atomic<bool> ended = false;
    request.upTo = stage;
    request.stageReady = [&](StageId ready, const PipelineOutput&) {
      if (ready != before) return;
      const double from = 1000.0 * processorSeconds();
      watch = std::thread([&, from] {
        while (!ended && 1000.0 * processorSeconds() - from < afterMs) std::this_thread::sleep_for(kBetweenLooks);
        cpu = 1000.0 * processorSeconds();
        wall = wallMs();
        context.cancel.cancel();
      });
    };
    const PipelineOutput out = runPipeline(scan_, recipe_, cache_, request, context);
    const double cpuEnd = 1000.0 * processorSeconds(), wallEnd = wallMs();
    ended = true;
    if (watch.joinable()) watch.join();
    if (!out.error) return std::nullopt;
    return Cancelled{cpuEnd - cpu, wallEnd - wall};
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
  std::array<double, kStages.size()> stageMs_{};
  int pieces_ = 0, extrema_ = 0;
};

void measure(const Page& page, const Recipe& recipe, int moments) {
  const auto cover = test::coverageOf({wave(page.rowPx, page.wavePx, page.heightPx, 1)}, kStrokePx, kPagePx, kPagePx);
  CancelledRuns runs(test::scanOfLines(cover, kPagePx, kPagePx, 1), recipe);
  std::printf("\n%s: %d pieces, %d extrema of curvature\n", page.name, runs.pieces(), runs.extrema());
  std::printf("%-12s %12s %9s %16s %16s\n", "stage", "stage CPU ms", "moments", "longest CPU ms", "longest wall ms");
  for (std::size_t i = 1; i < kStages.size(); ++i) {
    const StageId stage = kStages[i], before = kStages[i - 1] == StageId::Edges ? StageId::Filtered : kStages[i - 1];
    if (stage < StageId::Contours) continue;
    Cancelled longest;
    int heard = 0;
    for (int k = 0; k < moments; ++k) {
      const auto one = runs.cancelled(stage, before, runs.stageMs(stage) * (k + 0.5) / moments);
      if (!one) continue;
      ++heard;
      longest.cpuMs = std::max(longest.cpuMs, one->cpuMs);
      longest.wallMs = std::max(longest.wallMs, one->wallMs);
    }
    std::printf("%-12s %12.0f %9d %16.1f %16.1f\n", std::string(name(stage)).c_str(), runs.stageMs(stage), heard,
                longest.cpuMs, longest.wallMs);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Recipe recipe;
  recipe.corners.automatic = false;
  recipe.preparation.rulings = RulingUse::Keep;
  recipe.fairing.mode = FairingMode::Tolerance;
  int moments = kMomentsUsual;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      moments = std::max(1, std::atoi(word.c_str()));
      continue;
    }
    const auto done = setParameter(recipe, word.substr(0, equals), word.substr(equals + 1));
    if (done) continue;
    std::fprintf(stderr, "%s\n", done.error().message.c_str());
    return 2;
  }
  for (const Page& page : kPages) measure(page, recipe, moments);
  return 0;
}
