// SPDX-License-Identifier: GPL-3.0-or-later
// Lines found on papers that are hard to read: shading, ripples, folds and shadow edges under six drawings, each with
// four mixtures of contrast, noise and blur.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/base/statistics.h"
#include "core/curve/arc_length.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/bench/traced_lines.h"
#include "tests/support/angles.h"
#include "tests/support/stress_page.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr int kWidth = 1200, kHeight = 800;
constexpr StressInk kInks[] = {{20.0, 4.0, 0.8}, {10.0, 2.0, 0.8}, {30.0, 4.0, 3.0}, {30.0, 6.0, 1.0}};

/// A tone laid up to a bent edge and fading out behind it: `fade` px to the other side, 0 = the whole side is toned.
struct Tone {
  const char* name;
  bool closed;
  double fadePx;
};
constexpr Tone kTones[] = {{"closed, full tone", true, 0.0},
                           {"off the page, full tone", false, 0.0},
                           {"off the page, fading", false, 260.0},
                           {"closed, fading inward", true, 170.0}};

/// Distance into the tone (negative outside), and the edge.
double intoTone(const Tone& tone, double x, double y) {
  if (tone.closed) {
    const double dx = (x - 600.0) / 420.0, dy = (y - 400.0) / 270.0, r = std::hypot(dx, dy);
    return (1.0 - r) * r / std::max(1e-9, std::hypot(dx / 420.0, dy / 270.0));
  }
  const double slope = 160.0 * 2.0 * kPi / 1500.0 * std::cos(2.0 * kPi * x / 1500.0);
  return (y - 360.0 - 160.0 * std::sin(2.0 * kPi * x / 1500.0)) / std::hypot(1.0, slope);
}

/// How much of the tone every pixel has: it falls as exp(-d / fade) from the edge on, all blurred.
std::vector<float> blurredTone(const Tone& tone, double blurPx) {
  constexpr int kParts = 4;
  cv::Mat cover(kHeight, kWidth, CV_32F);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      double sum = 0.0;
      for (int k = 0; k < kParts * kParts; ++k) {
        const double d = intoTone(tone, x + (k % kParts + 0.5) / kParts, y + (k / kParts + 0.5) / kParts);
        if (d > 0.0) sum += tone.fadePx > 0.0 ? std::exp(-d / tone.fadePx) : 1.0;
      }
      cover.at<float>(y, x) = static_cast<float>(sum / (kParts * kParts));
    }
  }
  cv::GaussianBlur(cover, cover, {}, blurPx, blurPx, cv::BORDER_REPLICATE);
  return {cover.begin<float>(), cover.end<float>()};
}

std::vector<Vec2> toneEdge(const Tone& tone) {
  std::vector<Vec2> line;
  for (int i = 0; i <= 2400; ++i) {
    const double f = i / 2400.0, a = 2.0 * kPi * f;
    line.push_back(tone.closed ? Vec2(600.0 + 420.0 * std::cos(a), 400.0 + 270.0 * std::sin(a))
                               : Vec2(1200.0 * f, 360.0 + 160.0 * std::sin(2.0 * kPi * 1200.0 * f / 1500.0)));
  }
  return line;
}

struct TonePage {
  LineScore edge;
  double fairRmsPx = 0.0;  ///< Of the fair curves, where they are within 3 px.
};

TonePage measureTone(const Tone& tone, const Scan& scan) {
  StageCache cache;
  PipelineRequest request;
  request.needEdges = false;
  Recipe recipe;
  recipe.edges.internal = InnerBorders::On;
  recipe.edges.mode = EdgeMode::Outline;
  const PipelineOutput out = runPipeline(scan, recipe, cache, request, {});
  std::vector<std::vector<Vec2>> curves;
  if (out.faired) {
    for (const TracedCurve& c : out.faired->curves) {
      curves.emplace_back();
      const int count = std::clamp(static_cast<int>(out.frame.lengthToImage(c.fairedFigures.lengthMm)), 16, 20000);
      for (const CurveSample& s : sampleByArcLength(c.faired, count))
        curves.back().push_back(out.frame.pointToImage(s.point));
    }
  }
  const std::vector<std::vector<Vec2>> truth{toneEdge(tone)};
  return {scoreLines(truth, linesOf(out), kWidth, kHeight), scoreLines(truth, curves, kWidth, kHeight).rmsPx};
}

void measureTones(bool details) {
  std::printf("\nEdges of tones without a line, in outline mode, contrast 60 to 150, noise 2 to 8, blur 1 to 6 px.\n");
  std::printf("%-24s %8s %10s %10s %12s %12s\n", "tone", "passes", "least cov.", "false px", "worst edge",
              "worst curve");
  const std::vector<float> blank(std::ptrdiff_t{kWidth} * kHeight, 0.0f);
  for (const Tone& tone : kTones) {
    int good = 0, all = 0;
    double least = 1.0, most = 0.0, worst = 0.0;
    std::vector<double> fair;
    for (const double blur : {1.0, 3.0, 6.0}) {
      const std::vector<float> cover = blurredTone(tone, blur);
      for (const double contrast : {60.0, 100.0, 150.0}) {
        for (const double noise : {2.0, 8.0}) {
          const auto paper = [&](double x, double y) {
            const int pixel = static_cast<int>(y) * kWidth + static_cast<int>(x);
            return 235.0 - contrast * static_cast<double>(cover[pixel]);
          };
          const Scan scan = renderStress(blank, kWidth, kHeight, paper, {1.0, noise, 0.0}, 11);
          const TonePage page = measureTone(tone, scan);
          const LineScore& score = page.edge;
          good += score.passes() ? 1 : 0;
          ++all;
          least = std::min(least, score.covered);
          most = std::max(most, score.falsePx);
          worst = std::max(worst, score.rmsPx);
          fair.push_back(page.fairRmsPx);
          if (details)
            std::printf("  contrast %3.0f blur %1.0f noise %1.0f: covered %.3f, false %.0f px, rms %.3f, curve %.3f\n",
                        contrast, blur, noise, score.covered, score.falsePx, score.rmsPx, page.fairRmsPx);
        }
      }
    }
    std::printf("%-24s %3d / %2d %10.3f %10.0f %9.3f px %9.3f px\n", tone.name, good, all, least, most, worst,
                *std::max_element(fair.begin(), fair.end()));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  const bool details = argc > 2;
  const std::vector<StressScene> scenes = stressScenes(kWidth, kHeight);
  std::printf("Pages of %d x %d px; passes: 95 %% of the true lines within 2 px, at most 20 px of false ones.\n",
              kWidth, kHeight);
  std::printf("%-14s %8s %10s %10s %8s\n", "paper", "passes", "least cov.", "false px", "rms px");
  Recipe recipe;
  recipe.edges.internal = InnerBorders::On;
  int passes = 0, pages = 0;
  for (const StressPaper& paper : stressPapers(kWidth, kHeight)) {
    if (!only.empty() && paper.name.find(only) == std::string::npos) continue;
    int good = 0, all = 0;
    double least = 1.0, most = 0.0;
    std::vector<double> rms;
    for (const StressScene& scene : scenes) {
      for (const StressInk& ink : kInks) {
        const Scan scan = renderStress(scene.coverage, kWidth, kHeight, paper.grey, ink, 7);
        const LineScore score = scoreLines(scene.lines, tracedLines(scan, recipe), kWidth, kHeight);
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
    std::printf("%-14s %3d / %2d %10.3f %10.0f %8.3f\n", paper.name.c_str(), good, all, least, most, upperMedian(rms));
    std::fflush(stdout);
    passes += good;
    pages += all;
  }
  std::printf("%-14s %3d / %d\n", "all", passes, pages);
  if (only.empty() || only == "tone") measureTones(details);
  return 0;
}
