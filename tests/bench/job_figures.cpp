// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/job_figures.h"

#include <algorithm>
#include <limits>

#include "tests/bench/accuracy_measure.h"
#include "tests/support/render_page.h"

namespace batten::test {
namespace {

constexpr int kWidth = 1600, kHeight = 900;
constexpr double kStrokePx = 5.0, kClickPx = 6.0;
constexpr double kMostRmsPx = 0.08, kMostCornerPx = 0.5;

/// How far the worst corner lies from the truth; infinite if one was not found.
double worstCorner(const Accuracy& accuracy) {
  double worst = 0.0;
  for (const Accuracy::CornerError& corner : accuracy.corners) worst = std::max(worst, corner.errorPx);
  return worst;
}

void addFaired(std::vector<JobFigure>& figures, const std::string& scene, const TruthShape& shape, const Scan& scan) {
  for (const auto& [mode, name] : {std::pair{FairingMode::Tolerance, "faired within the tolerance"},
                                   {FairingMode::Target, "faired towards the recommended target"}}) {
    Recipe recipe;
    recipe.construct.light = false;
    recipe.corners.automatic = false;
    recipe.fairing.mode = mode;
    const Accuracy faired = compareWithTruth(shape, traceShape(shape, scan, recipe, kClickPx));
    const std::string what = ", " + std::string(name);
    figures.push_back({scene, "false extrema" + what, static_cast<double>(faired.falseExtrema), 0.0});
    figures.push_back({scene, "missed extrema" + what, static_cast<double>(faired.missedExtrema), 0.0});
  }
}

}  // namespace

std::vector<JobFigure> mainJob(std::uint32_t seed) {
  std::vector<JobFigure> figures;
  for (const char* name : {"ellipse", "clothoid", "car"}) {
    const TruthShape shape = truthShape(name, kWidth, kHeight);
    const std::vector<Vec2> outline = shape.outline();
    for (const bool stroke : {false, true}) {
      const auto coverage =
          stroke ? strokeCoverage(outline, true, kStrokePx, kWidth, kHeight) : fillCoverage(outline, kWidth, kHeight);
      const Scan scan = renderPage(coverage, kWidth, kHeight, gradatedPage(seed));
      const std::string scene = std::string(name) + (stroke ? ", line" : ", filled");
      Recipe dense;
      dense.construct.light = false;
      dense.corners.automatic = false;
      const TraceResult traced = traceShape(shape, scan, dense, kClickPx);
      const Accuracy accuracy = compareWithTruth(shape, traced);
      const double rms = accuracy.found ? accuracy.rmsPx : std::numeric_limits<double>::infinity();
      figures.push_back({scene, "rms from the truth, px", rms, kMostRmsPx});
      if (!shape.corners.empty()) figures.push_back({scene, "worst corner, px", worstCorner(accuracy), kMostCornerPx});
      if (shape.name != "car") addFaired(figures, scene, shape, scan);
    }
  }
  return figures;
}

}  // namespace batten::test
