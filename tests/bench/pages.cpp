// SPDX-License-Identifier: GPL-3.0-or-later
// Lines found on papers that are hard to read: shading, ripples, folds and shadow edges under six drawings, each with
// four mixtures of contrast, noise and blur.

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "core/pipeline/pipeline.h"
#include "tests/support/stress_page.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr int kWidth = 1200, kHeight = 800;
constexpr StressInk kInks[] = {{20.0, 4.0, 0.8}, {10.0, 2.0, 0.8}, {30.0, 4.0, 3.0}, {30.0, 6.0, 1.0}};

std::vector<std::vector<Vec2>> tracedLines(const Scan& scan) {
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Contours;
  request.needEdges = false;
  Recipe recipe;
  recipe.edges.internal = true;
  const PipelineOutput out = runPipeline(scan, recipe, cache, request, {});
  std::vector<std::vector<Vec2>> lines;
  if (!out.contours) return lines;
  for (const Contour& c : out.contours->contours) {
    lines.push_back(c.points);
    if (c.closed && !c.points.empty()) lines.back().push_back(c.points.front());
  }
  return lines;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  const bool details = argc > 2;
  const std::vector<StressScene> scenes = stressScenes(kWidth, kHeight);
  std::printf("Pages of %d x %d px; passes: 95 %% of the true lines within 2 px, at most 20 px of false ones.\n",
              kWidth, kHeight);
  std::printf("%-14s %8s %10s %10s %8s\n", "paper", "passes", "least cov.", "false px", "rms px");
  int passes = 0, pages = 0;
  for (const StressPaper& paper : stressPapers(kWidth, kHeight)) {
    if (!only.empty() && paper.name.find(only) == std::string::npos) continue;
    int good = 0, all = 0;
    double least = 1.0, most = 0.0;
    std::vector<double> rms;
    for (const StressScene& scene : scenes) {
      for (const StressInk& ink : kInks) {
        const Scan scan = renderStress(scene.coverage, kWidth, kHeight, paper.grey, ink, 7);
        const LineScore score = scoreLines(scene.lines, tracedLines(scan), kWidth, kHeight);
        good += score.passes() ? 1 : 0;
        ++all;
        least = std::min(least, score.covered);
        most = std::max(most, score.falsePx);
        rms.push_back(score.rmsPx);
        if (details && !score.passes())
          std::printf("  %-10s contrast %2.0f noise %1.0f blur %.1f: covered %.3f, false %.0f px\n", scene.name.c_str(),
                      ink.contrast, ink.noise, ink.blurPx, score.covered, score.falsePx);
      }
    }
    std::nth_element(rms.begin(), rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2), rms.end());
    std::printf("%-14s %3d / %2d %10.3f %10.0f %8.3f\n", paper.name.c_str(), good, all, least, most,
                rms[rms.size() / 2]);
    std::fflush(stdout);
    passes += good;
    pages += all;
  }
  std::printf("%-14s %3d / %d\n", "all", passes, pages);
  return 0;
}
