// SPDX-License-Identifier: GPL-3.0-or-later
// Times of the chain on an A4 page at 300 dpi, stage by stage and as a whole, and of the six targets of a 40-point
// curve. bench_speed --page [ROUNDS]: of an A4 page at 600 dpi, beside a copy of the page and a fixed loop.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/construct/nurbs/quintic_nurbs.h"
#include "core/curve/knot_operations.h"
#include "core/fairing/fairing.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/bench/large_page_speed.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr int kWidth = 3508, kHeight = 2480;  // A4 across, 300 dpi, 8.7 megapixels

/// All nine shapes as 9 px pen strokes on one gradated, noisy page would overlap: the car outline and two ellipses do
/// not.
const Scan& page() {
  static const Scan scan = [] {
    std::vector<float> coverage =
        strokeCoverage(truthShape("car", kWidth, kHeight).outline(), true, 9.0, kWidth, kHeight);
    inkOver(coverage, strokeCoverage(truthShape("ellipse", kWidth, kHeight).outline(), true, 7.0, kWidth, kHeight));
    return renderPage(std::move(coverage), kWidth, kHeight, gradatedPage(1));
  }();
  return scan;
}

void runChain(benchmark::State& state, const Recipe& recipe) {
  const Scan& scan = page();
  std::array<double, kStages.size()> total{};
  for (auto _ : state) {
    StageCache cache;
    PipelineRequest request;
    request.needEdges = false;  // as the command line runs it
    const PipelineOutput output = runPipeline(scan, recipe, cache, request, {});
    if (output.error) state.SkipWithError(output.error->message.c_str());
    for (std::size_t i = 0; i < kStages.size(); ++i) total[i] += output.timing[i].milliseconds;
  }
  for (std::size_t i = 0; i < kStages.size(); ++i)
    state.counters[std::string(name(kStages[i])) + "_ms"] =
        benchmark::Counter(total[i], benchmark::Counter::kAvgIterations);
}

void chainDefault(benchmark::State& state) { runChain(state, Recipe{}); }
// What the default was before curves were made light and corners found: the same work as then.
void chainDense(benchmark::State& state) {
  Recipe recipe;
  recipe.construct.light = false;
  recipe.corners.automatic = false;
  runChain(state, recipe);
}
void chainOutlineNurbs(benchmark::State& state) {
  Recipe recipe;
  recipe.edges.mode = EdgeMode::Outline;
  recipe.construct.method = ConstructMethod::Nurbs;
  runChain(state, recipe);
}

/// A wavering roof line of 40 control points.
NurbsCurve fortyPoints() {
  std::vector<Vec2> points;
  std::vector<double> knots(6, 0.0);
  for (int i = 0; i < 40; ++i) {
    const double f = i / 39.0;
    points.emplace_back(280.0 * f, 60.0 * std::sin(3.0 * f) + 0.15 * std::sin(40.0 * f));
  }
  for (int i = 1; i < 35; ++i) knots.push_back(8.0 * i);
  knots.insert(knots.end(), 6, 8.0 * 35);
  return *NurbsCurve::make(5, knots, points);
}

void fairSix(benchmark::State& state, TargetSpans spans) {
  const NurbsCurve curve = fortyPoints();
  FairingParams params;
  params.mode = FairingMode::Target;
  params.targets.spans = spans;
  for (auto _ : state) benchmark::DoNotOptimize(fairAllTargets(curve, false, params, {}));
}
void sixTargets(benchmark::State& state) { fairSix(state, TargetSpans::Natural); }
// What it was before targets were laid on natural spans: one polynomial from end to end.
void sixWholeTargets(benchmark::State& state) { fairSix(state, TargetSpans::Whole); }

BENCHMARK(chainDefault)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(chainDense)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(chainOutlineNurbs)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(sixWholeTargets)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(sixTargets)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  if (argc >= 2 && std::strcmp(argv[1], "--page") == 0) {
    constexpr int kRounds = 7;
    printLargePageSpeed(argc >= 3 ? std::max(1, std::atoi(argv[2])) : kRounds);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
