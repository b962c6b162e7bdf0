// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how near the traced curves come to shapes whose exact course is known, beside the goals and beside what other
// tracers make of the same pages.
//
//   bench_accuracy [--seeds N] [--peer-seeds N] [--sizes 1200x800,2480x3508] [--kinds outline,stroke]
//                  [--cases clean,scan,dark,varying,foundation] [--shapes a,b,…] [--click PX] [--brief] [--corners]
//                  [--set stage.parameter=value …]
//
// rms, max, curvature error (kappa times the size of the shape): medians over the shapes. False and missed extrema: per
// seed, summed over the shapes. Corners: clicked 8 px beside the truth; found of those there; rms of their distance for
// those whose sides open by 40 degrees or more, and for the sharper ones. --corners lists each of them. Flat:
// percentage of the stretches between extrema along which the curvature hardly changes (by less than a twentieth of the
// mean of its stretch), after the same for the truth. Clean pages have no seed. On varying ones the noise grows sixfold
// from left to right while the contrast falls to a third. The goals are those of 1200 x 800. Everything is run twice,
// with construct.light=false and true, unless --set says which; points of light curves: each once, exact lines 2, exact
// arcs and circles 3. Both with corners.auto=false; then once more with light curves and corners.auto=true, without a
// click: only then are corners counted that are none (false corners: 4 px and more from every true one).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/statistics.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "tests/bench/accuracy_measure.h"
#include "tests/bench/accuracy_peers.h"
#include "tests/support/render_page.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr double kStrokePx = 5.0;

struct Options {
  int seeds = 2, peerSeeds = 1;
  double clickPx = 8.0;
  bool brief = false, corners = false;
  std::vector<std::string> shapes, cases = {"clean", "scan", "dark"}, kinds = {"outline", "stroke"},
                                   sizes = {"1200x800", "2480x3508"};
  Recipe recipe;
  std::vector<bool> light = {false, true};      ///< The dense curves' block, and that of the light ones.
  std::vector<bool> automatic = {false, true};  ///< Corners by clicks, and found by the program.
};

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

void set(Recipe& recipe, const std::string& setting) {
  const std::size_t equals = std::min(setting.find('='), setting.size() - 1);
  const auto done = setParameter(recipe, setting.substr(0, equals), setting.substr(equals + 1));
  if (done) return;
  std::fprintf(stderr, "%s\n", done.error().message.c_str());
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--brief") {
      options.brief = true;
      continue;
    }
    if (word == "--corners") {
      options.corners = true;
      continue;
    }
    const std::string value = i + 1 < argc ? argv[++i] : "";
    if (word == "--seeds") {
      options.seeds = std::max(1, std::atoi(value.c_str()));
    } else if (word == "--peer-seeds") {
      options.peerSeeds = std::max(0, std::atoi(value.c_str()));
    } else if (word == "--click") {
      options.clickPx = std::atof(value.c_str());
    } else if (word == "--shapes") {
      options.shapes = splitAtCommas(value);
    } else if (word == "--cases") {
      options.cases = splitAtCommas(value);
    } else if (word == "--kinds") {
      options.kinds = splitAtCommas(value);
    } else if (word == "--sizes") {
      options.sizes = splitAtCommas(value);
    } else if (word == "--set") {
      set(options.recipe, value);
      if (value.starts_with("corners.auto=")) options.automatic = {options.recipe.corners.automatic};
      if (value.starts_with("construct.light=")) options.light = {options.recipe.construct.light};
    } else {
      std::fprintf(stderr, "unknown option %s\n", word.c_str());
      std::exit(2);
    }
  }
  return options;
}

PageStyle styleOf(const std::string& name, std::uint32_t seed) {
  if (name == "clean") return cleanPage();
  if (name == "dark") return darkPage(seed);
  if (name == "varying") return varyingPage(seed);
  PageStyle style = name == "foundation" ? gradatedPage(seed) : scannedPage(seed);
  if (name == "scan") style.jpegQuality = 85;
  return style;
}

constexpr double kAcuteDeg = 40.0;
constexpr double kCornerGoalPx = 0.1, kAcuteGoalPx = 0.5;

/// The figures asked for, at 1200 x 800; at finer resolutions the lines are longer and everything comes easier.
struct Goal {
  const char *kind, *name;
  double rms, max, curvature;
  int falseExtrema;
};
constexpr Goal kGoals[] = {{"outline", "clean", 0.012, 0.1, 0.02, 0}, {"outline", "scan", 0.016, 0.12, 0.04, 0},
                           {"outline", "dark", 0.04, 0.3, 0.1, 0},    {"stroke", "clean", 0.006, 0.05, 0.02, 0},
                           {"stroke", "scan", 0.011, 0.06, 0.03, 0},  {"stroke", "dark", 0.03, 0.15, 0.1, 1}};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const std::ptrdiff_t n = std::ssize(values);
  const double lower = elementOfRank(values, (n - 1) / 2);
  return 0.5 * (lower + upperMedian(values));
}

double rmsOf(const std::vector<double>& values) {
  double square = 0.0;
  for (const double v : values) square += v * v;
  return values.empty() ? 0.0 : std::sqrt(square / static_cast<double>(values.size()));
}

/// What one tracer reached on one shape (all seeds), or on all shapes.
struct Tally {
  std::vector<double> rms, max, curvature, corner, acute, ms, coverage, stray;
  int falseExtrema = 0, missed = 0, cornersFound = 0, cornersTrue = 0, cornersFalse = 0, found = 0, runs = 0;
  double points = 0, monotonePx = 0, flatPx = 0, trueMonotonePx = 0, trueFlatPx = 0;
  std::string failure;
  std::vector<Accuracy::CornerError> each;

  void add(const Accuracy& a, const TraceResult& r) {
    rms.push_back(a.rmsPx);
    max.push_back(a.maxPx);
    curvature.push_back(a.curvatureError);
    ms.push_back(r.milliseconds);
    coverage.push_back(a.coverage);
    stray.push_back(a.outlierPx);
    each.insert(each.end(), a.corners.begin(), a.corners.end());
    for (const Accuracy::CornerError& c : a.corners)
      if (std::isfinite(c.errorPx)) (c.openingDeg < kAcuteDeg ? acute : corner).push_back(c.errorPx);
    falseExtrema += a.falseExtrema;
    missed += a.missedExtrema;
    cornersFound += a.cornersFound;
    cornersTrue += a.cornersTrue;
    cornersFalse += a.cornersFalse;
    found += a.found ? 1 : 0;
    points += r.controlPoints;
    monotonePx += a.monotonePx;
    flatPx += a.flatPx;
    trueMonotonePx += a.trueMonotonePx;
    trueFlatPx += a.trueFlatPx;
    ++runs;
    if (failure.empty()) failure = r.failure;
  }
  void addShape(const Tally& t) {
    rms.push_back(median(t.rms));
    max.push_back(median(t.max));
    curvature.push_back(median(t.curvature));
    ms.push_back(median(t.ms));
    coverage.push_back(*std::min_element(t.coverage.begin(), t.coverage.end()));
    stray.push_back(*std::max_element(t.stray.begin(), t.stray.end()));
    corner.insert(corner.end(), t.corner.begin(), t.corner.end());
    acute.insert(acute.end(), t.acute.begin(), t.acute.end());
    falseExtrema += t.falseExtrema;
    missed += t.missed;
    cornersFound += t.cornersFound;
    cornersTrue += t.cornersTrue;
    cornersFalse += t.cornersFalse;
    found += t.found;
    points += t.points;
    monotonePx += t.monotonePx;
    flatPx += t.flatPx;
    trueMonotonePx += t.trueMonotonePx;
    trueFlatPx += t.trueFlatPx;
    runs += t.runs;
  }
};

void printHeader(const std::string& kind, const std::string& name, const std::string& size) {
  std::printf("\n%s, %s, %s\n%-18s %8s %8s %9s %7s %7s %9s %8s %8s %8s %7s %7s %7s %9s %8s\n", kind.c_str(),
              name.c_str(), size.c_str(), "", "rms px", "max px", "kappa err", "false", "missed", "corners", "rms px",
              "<40 px", "found", "curve %", "stray", "points", "flat %", "ms");
}

void printTally(const std::string& label, const Tally& t, int seeds, bool curvature = true) {
  if (t.runs == 0) return;
  char extrema[48] = "      -       -", kappa[16] = "        -", flat[32] = "-";
  if (curvature) {
    std::snprintf(kappa, sizeof kappa, "%9.3f", median(t.curvature));
    std::snprintf(extrema, sizeof extrema, "%7.1f %7.1f", 1.0 * t.falseExtrema / seeds, 1.0 * t.missed / seeds);
    std::snprintf(flat, sizeof flat, "%.0f>%.0f", 100.0 * t.trueFlatPx / std::max(1.0, t.trueMonotonePx),
                  100.0 * t.flatPx / std::max(1.0, t.monotonePx));
  }
  std::printf("%-18s %8.4f %8.3f %s %s %4d/%-4d %8.3f %8.3f %4d/%-3d %7.1f %7.0f %7.0f %9s %8.1f %s\n", label.c_str(),
              median(t.rms), median(t.max), kappa, extrema, t.cornersFound, t.cornersTrue, rmsOf(t.corner),
              rmsOf(t.acute), t.found, t.runs, 100.0 * median(t.coverage),
              *std::max_element(t.stray.begin(), t.stray.end()), t.points / t.runs, flat, median(t.ms),
              t.failure.c_str());
  std::fflush(stdout);
}

void printGoal(const Goal& g) {
  std::printf("%-18s %8.4f %8.3f %9.3f %7d %7d       all %8.3f %8.3f      all\n", "goal", g.rms, g.max, g.curvature,
              g.falseExtrema, 0, kCornerGoalPx, kAcuteGoalPx);
}

/// Figure by figure below the goal. Nothing to judge: "-".
void printVerdict(const Goal& g, const Tally& t, int seeds) {
  const auto met = [](bool yes) { return yes ? "met" : "MISSED"; };
  const auto cornerMet = [&](const std::vector<double>& errors, double goal) {
    return errors.empty() ? "-" : met(rmsOf(errors) <= goal);
  };
  std::printf("%-18s %8s %8s %9s %7s %7s %9s %8s %8s %8s\n", "", met(median(t.rms) <= g.rms),
              met(median(t.max) <= g.max), met(median(t.curvature) <= g.curvature),
              met(t.falseExtrema <= g.falseExtrema * seeds), met(t.missed == 0),
              t.cornersTrue == 0 ? "-" : met(t.cornersFound == t.cornersTrue), cornerMet(t.corner, kCornerGoalPx),
              cornerMet(t.acute, kAcuteGoalPx), met(t.found == t.runs));
}

/// Every corner of a shape over the seeds.
void printCorners(const Tally& t) {
  std::size_t count = 0;
  for (const auto& c : t.each) count = std::max(count, c.corner + 1);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> errors;
    double opening = 0.0;
    Vec2 sum = Vec2::Zero();
    int all = 0;
    for (const auto& c : t.each) {
      if (c.corner != i) continue;
      opening = c.openingDeg;
      ++all;
      if (!std::isfinite(c.errorPx)) continue;
      errors.push_back(c.errorPx);
      sum += c.offPx;
    }
    // The mean of n misses without bias is about rms / sqrt(n) long.
    std::printf("      corner %2zu opens %6.1f degrees: %zu of %d, %.3f px; mean miss %.3f px\n", i, opening,
                errors.size(), all, rmsOf(errors),
                errors.empty() ? 0.0 : sum.norm() / static_cast<double>(errors.size()));
  }
}

struct Bench {
  Options options;
  std::vector<Peer> others = peers();
  std::filesystem::path folder;

  void runPeers(const TruthShape& shape, const Scan& scan, bool stroke, std::vector<Tally>& tallies) const {
    const std::filesystem::path pgm = folder / "page.pgm";
    if (!writePgm(scan.grey, pgm)) return;
    for (std::size_t p = 0; p < others.size(); ++p) {
      if (!others[p].missing.empty()) continue;
      const auto result = others[p].run(pgm, folder);
      if (result) tallies[p].add(compareWithTruth(shape, *result, stroke ? 0.5 * kStrokePx : 0.0), *result);
    }
  }

  void runCase(const std::string& kind, const std::string& name, const std::string& size) const {
    const bool stroke = kind == "stroke";
    const int width = std::atoi(size.c_str()),
              height = std::atoi(size.c_str() + std::min(size.size(), size.find('x') + 1));
    const int seeds = name == "clean" ? 1 : options.seeds;
    printHeader(kind == "stroke" ? "5 px stroke" : "filled outline", name, size);
    Tally all;
    std::vector<Tally> allPeers(others.size());
    int peerSeeds = std::min(seeds, options.peerSeeds);
    for (const TruthShape& shape : truthShapes(width, height)) {
      if (!options.shapes.empty() &&
          std::find(options.shapes.begin(), options.shapes.end(), shape.name) == options.shapes.end())
        continue;
      const std::vector<Vec2> outline = shape.outline();
      const std::vector<float> coverage =
          stroke ? strokeCoverage(outline, true, kStrokePx, width, height) : fillCoverage(outline, width, height);
      Tally tally;
      std::vector<Tally> peerTallies(others.size());
      for (int seed = 1; seed <= seeds; ++seed) {
        const Scan scan = renderPage(coverage, width, height, styleOf(name, static_cast<std::uint32_t>(seed)));
        const TraceResult result = traceShape(shape, scan, options.recipe, options.clickPx);
        tally.add(compareWithTruth(shape, result), result);
        if (seed <= peerSeeds) runPeers(shape, scan, stroke, peerTallies);
      }
      if (!options.brief) printTally("  " + shape.name, tally, seeds);
      if (options.corners) printCorners(tally);
      all.addShape(tally);
      for (std::size_t p = 0; p < others.size(); ++p)
        if (peerTallies[p].runs > 0) allPeers[p].addShape(peerTallies[p]);
    }
    printTally("Batten", all, seeds);
    if (options.recipe.corners.automatic)
      std::printf("%-18s %d of %d without a click, %d false\n", "corners", all.cornersFound, all.cornersTrue,
                  all.cornersFalse);
    for (const Goal& g : kGoals) {
      if (kind != g.kind || name != g.name) continue;
      printGoal(g);
      printVerdict(g, all, seeds);
    }
    for (std::size_t p = 0; p < others.size(); ++p)
      printTally(others[p].name + (stroke ? " (borders)" : ""), allPeers[p], std::max(1, peerSeeds), !stroke);
  }
};

}  // namespace

int main(int argc, char** argv) {
  Bench bench;
  bench.options = parse(argc, argv);
  bench.folder = std::filesystem::temp_directory_path() / ("batten-accuracy-" + std::to_string(std::rand()));
  std::filesystem::create_directories(bench.folder);
  if (bench.options.peerSeeds > 0)
    for (const Peer& peer : bench.others)
      if (!peer.missing.empty()) std::printf("%s: %s\n", peer.name.c_str(), peer.missing.c_str());
  bench.options.recipe.corners.automatic = false;
  for (const bool light : bench.options.light) {
    if (!bench.options.automatic.empty() && bench.options.automatic.front()) break;
    std::printf(light ? "\nLight curves, construct.light=true\n" : "Dense curves, construct.light=false\n");
    bench.options.recipe.construct.light = light;
    for (const std::string& size : bench.options.sizes)
      for (const std::string& kind : bench.options.kinds)
        for (const std::string& name : bench.options.cases) bench.runCase(kind, name, size);
    bench.options.peerSeeds = 0;  // once is enough
  }
  if (bench.options.automatic.back()) {
    std::printf("\nWithout a click, corners.auto=true\n");
    bench.options.recipe.corners.automatic = true;
    bench.options.recipe.construct.light = bench.options.light.back();
    for (const std::string& size : bench.options.sizes)
      for (const std::string& kind : bench.options.kinds)
        for (const std::string& name : bench.options.cases) bench.runCase(kind, name, size);
  }
  std::filesystem::remove_all(bench.folder);
  return 0;
}
