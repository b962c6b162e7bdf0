// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how near the traced curves come to shapes whose exact course is known.
//
//   bench_accuracy [--seeds N] [--shapes a,b,…] [--case foundation,clean,scan,dark] [--set stage.parameter=value]
//   [--strokes]

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "core/pipeline/parameter_table.h"
#include "tests/bench/accuracy_measure.h"
#include "tests/support/render_page.h"

using namespace batten;
using namespace batten::test;

namespace {

struct Options {
  int seeds = 3;
  std::vector<std::string> shapes, cases = {"foundation", "clean", "scan", "dark"}, settings;
  bool strokes = false, outlines = true;
};

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (word == "--strokes") {
      options.strokes = true;
      options.outlines = false;
      continue;
    }
    if (word == "--seeds") options.seeds = std::max(1, std::atoi(value.c_str()));
    if (word == "--shapes") options.shapes = splitAtCommas(value);
    if (word == "--case") options.cases = splitAtCommas(value);
    if (word == "--set") options.settings.push_back(value);
    ++i;
  }
  return options;
}

PageStyle styleOf(const std::string& name, std::uint32_t seed) {
  if (name == "clean") return cleanPage();
  if (name == "scan") return scannedPage(seed);
  if (name == "dark") return darkPage(seed);
  return gradatedPage(seed);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void printHeader(const std::string& name, const char* kind, int width, int height) {
  std::printf("\n%s, %s, %d x %d\n%-10s %8s %8s %9s %8s %9s %9s %6s %6s %8s\n", name.c_str(), kind, width, height,
              "shape", "rms px", "max px", "kappa err", "extrema", "corners", "corner px", "points", "found", "ms");
}

void runCase(const std::string& name, bool stroke, const Options& options) {
  const bool foundation = name == "foundation";
  const int width = foundation ? 1600 : 1200, height = foundation ? 900 : 800;
  printHeader(name, stroke ? "5 px stroke" : "filled outline", width, height);
  std::vector<double> allRms, allMax, allCurvature;
  int falseExtrema = 0, missedExtrema = 0, runs = 0, found = 0;
  for (const TruthShape& shape : truthShapes(width, height)) {
    if (!options.shapes.empty() &&
        std::find(options.shapes.begin(), options.shapes.end(), shape.name) == options.shapes.end())
      continue;
    if (foundation && options.shapes.empty() && shape.name != "ellipse" && shape.name != "clothoid" &&
        shape.name != "car")
      continue;
    const std::vector<Vec2> outline = shape.outline();
    const std::vector<float> coverage =
        stroke ? strokeCoverage(outline, true, 5.0, width, height) : fillCoverage(outline, width, height);
    std::vector<double> rms, max, curvature, corner, ms;
    Accuracy last;
    int foundHere = 0;
    for (int seed = 1; seed <= (name == "clean" ? 1 : options.seeds); ++seed) {
      Recipe recipe;
      if (!stroke) recipe.edges.mode = EdgeMode::Outline;
      for (const std::string& setting : options.settings) {
        const std::size_t equals = setting.find('=');
        if (const auto done = setParameter(recipe, setting.substr(0, equals), setting.substr(equals + 1)); !done) {
          std::fprintf(stderr, "%s\n", done.error().message.c_str());
          std::exit(2);
        }
      }
      const Scan scan = renderPage(coverage, width, height, styleOf(name, static_cast<std::uint32_t>(seed)));
      AccuracyCase how;
      how.faired = recipe.fairing.mode != FairingMode::None;
      last = measureAccuracy(shape, scan, recipe, how);
      rms.push_back(last.rmsPx);
      max.push_back(last.maxPx);
      curvature.push_back(last.curvatureError);
      corner.push_back(last.cornerRmsPx);
      ms.push_back(last.milliseconds);
      falseExtrema += std::max(0, last.extrema - last.trueExtrema);
      missedExtrema += std::max(0, last.trueExtrema - last.extrema);
      foundHere += last.found ? 1 : 0;
    }
    const int tried = static_cast<int>(rms.size());
    std::printf("%-10s %8.4f %8.3f %9.3f %4d/%-3d %5d/%-3d %9.3f %6d %3d/%-3d %8.1f %s\n", shape.name.c_str(),
                median(rms), median(max), median(curvature), last.extrema, last.trueExtrema, last.cornersFound,
                last.cornersTrue, median(corner), last.controlPoints, foundHere, tried, median(ms),
                last.failure.c_str());
    std::fflush(stdout);
    allRms.push_back(median(rms));
    allMax.push_back(median(max));
    allCurvature.push_back(median(curvature));
    runs += tried;
    found += foundHere;
  }
  std::printf("%-10s %8.4f %8.3f %9.3f   false extrema %d, missed %d over %d runs; found %d of %d\n", "median",
              median(allRms), median(allMax), median(allCurvature), falseExtrema, missedExtrema, runs, found, runs);
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  for (const std::string& name : options.cases) {
    if (options.outlines) runCase(name, false, options);
    if (options.strokes) runCase(name, true, options);
  }
  return 0;
}
