// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how the constructions compare on lines whose exact course is known: noise 0.3 px, seeds 1..10.
//
//   bench_methods [--seeds N] [--noise PX] [--shapes a,b,…] [--methods a,b,…] [--each]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/statistics.h"
#include "core/construct/construct.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/curvature_jump.h"
#include "core/fairing/fairing.h"
#include "core/fairing/model/fairing_line.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "tests/support/method_truths.h"
#include "tests/support/truth_shapes.h"

using namespace batten;
using namespace batten::test;

namespace {

struct Method {
  std::string name;
  std::vector<std::string> settings;
};

std::vector<Method> methods() {
  return {
      {"fair", {"construct.method=fair"}},
      {"nurbs", {"construct.method=nurbs"}},
      {"nurbs from fit", {"construct.method=nurbs", "construct.start=fit"}},
      {"nurbs+tolerance", {"construct.method=nurbs", "fairing.mode=tolerance", "fairing.tolerance=0.5"}},
      {"nurbs+all", {"construct.method=nurbs", "fairing.mode=tolerance", "fairing.tolerance=0.5", "fairing.spend=all"}},
      {"nurbs+target", {"construct.method=nurbs", "fairing.mode=target", "fairing.tolerance=0.5"}},
      {"nurbs+monotone", {"construct.method=nurbs", "fairing.mode=monotone", "fairing.tolerance=0.5"}},
      {"nurbs+lowpass", {"construct.method=nurbs", "fairing.mode=lowpass", "fairing.tolerance=0.5"}},
      // The knots lie 20 to 40 px apart: a filter of 20 px finds hardly any wave to take.
      {"nurbs+lowpass100",
       {"construct.method=nurbs", "fairing.mode=lowpass", "fairing.lowpass=100", "fairing.tolerance=0.5"}},
      {"bezier", {"construct.method=bezier"}},
      {"bezier from fit", {"construct.method=bezier", "construct.start=fit"}},
      {"typical", {"construct.method=typical"}},
      {"typical-growing", {"construct.method=typical", "construct.typical=growing"}},
      {"control-polygon", {"construct.method=control-polygon"}}};
}

/// A program that does not know a fairing way yet leaves its row out.
bool apply(const Method& method, Recipe& recipe) {
  for (const std::string& setting : method.settings) {
    const auto equals = setting.find('=');
    if (!setParameter(recipe, setting.substr(0, equals), setting.substr(equals + 1))) return false;
  }
  return true;
}

ConstructContour contourOf(const std::vector<Vec2>& points, const SegmentParams& params) {
  PieceSet set;
  Piece& piece = set.pieces.emplace_back();
  piece.points = piecePoints(points);
  for (std::size_t i = 1; i < points.size(); ++i) piece.lengthPx += (points[i] - points[i - 1]).norm();
  ConstructContour contour;
  ConstructPiece& made = contour.pieces.emplace_back();
  made.points = piecePoints(points);
  if (const auto segments = regressionSegments(set, params, {})) made.stations = segments->pieces[0].stations;
  return contour;
}

struct Outcome {
  double rms = 0, max = 0, kappa = 0, jump = 0, ms = 0;
  int extrema = 0, controlPoints = 0, notMonotone = 0, typical = 0;
  std::string problem;
};

Outcome measure(const OpenTruth& truth, const Recipe& recipe, double noise, unsigned seed) {
  Outcome out;
  const ConstructContour contour = contourOf(noisyPoints(truth, noise, seed), recipe.segments);
  const auto begin = std::chrono::steady_clock::now();
  ConstructParams params = recipe.construct;
  params.light = false;  // what the constructions give themselves
  auto made = construct(contour, params, {});
  if (!made) {
    out.problem = made.error().message;
    return out;
  }
  NurbsCurve curve = made->front().curve;
  if (recipe.fairing.mode != FairingMode::None) {
    const auto faired = fair(curve, false, recipe.fairing, {}, FairingLine{positionsOf(contour.pieces[0].points), 1.0});
    if (faired)
      curve = faired->curve;
    else
      out.problem = faired.error().message;
  }
  out.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  const Deviation away = deviation(curve, truth.points, true);
  out.rms = away.rms;
  out.max = away.max;
  const auto samples = sampleByArcLength(curve, 1001);
  double misfit = 0.0, size = 0.0;
  for (std::size_t i = 50; i <= 950; ++i) {
    const auto at = static_cast<int>(static_cast<double>(i) / 1000.0 * static_cast<double>(truth.kappa.size() - 1));
    misfit += std::pow(samples[i].kappa - truth.kappa[at], 2);
    size += std::pow(truth.kappa[at], 2);
  }
  out.kappa = std::sqrt(misfit / size);
  out.extrema = static_cast<int>(curvatureExtrema(curve, kExtremumProminence / extent(curve), false).size());
  out.jump = largestCurvatureJump(curve, false);
  out.controlPoints = curve.controlPointCount();
  for (const SegmentNote& note : made->front().report.segments) {
    out.typical += note.typical;
    out.notMonotone += note.typical && !note.monotone;
  }
  return out;
}

double median(std::vector<double> values) { return values.empty() ? 0.0 : upperMedian(values); }

bool isIn(const std::string& list, const std::string& word) {
  std::stringstream in(list);
  for (std::string part; std::getline(in, part, ',');) {
    if (part == word) return true;
  }
  return list.empty();
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 10;
  double noise = 0.3;
  std::string shapes, wanted;
  bool each = false;
  std::vector<std::string> settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (word == "--each") each = true;
    if (word == "--seeds") seeds = std::max(1, std::atoi(value.c_str()));
    if (word == "--noise") noise = std::atof(value.c_str());
    if (word == "--shapes") shapes = value;
    if (word == "--methods") wanted = value;
    if (word == "--set") settings.push_back(value);
  }
  for (const OpenTruth& truth : openTruths()) {
    if (!isIn(shapes, truth.name)) continue;
    Vec2 low = truth.points.front(), high = low;
    for (const Vec2& p : truth.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const int trueExtrema = countExtrema(truth.kappa, kExtremumProminence / (high - low).norm(), false);
    std::printf("\n%s, noise %.2f px, %d seeds, %d extrema\n%-16s %8s %8s %8s %9s %9s %7s %9s %8s\n",
                truth.name.c_str(), noise, seeds, trueExtrema, "method", "rms px", "max px", "kappa", "false ex",
                "missed", "points", "jump", "ms");
    for (Method method : methods()) {
      if (!isIn(wanted, method.name)) continue;
      Recipe recipe;
      method.settings.insert(method.settings.end(), settings.begin(), settings.end());
      if (!apply(method, recipe)) continue;
      std::vector<double> rms, max, kappa, points, jump, ms;
      int extra = 0, missed = 0, notMonotone = 0, typical = 0, failed = 0;
      for (int seed = 1; seed <= seeds; ++seed) {
        const Outcome one = measure(truth, recipe, noise, static_cast<unsigned>(seed));
        if (!one.problem.empty()) ++failed;
        rms.push_back(one.rms);
        max.push_back(one.max);
        kappa.push_back(one.kappa);
        points.push_back(one.controlPoints);
        jump.push_back(one.jump);
        ms.push_back(one.ms);
        extra += std::max(0, one.extrema - trueExtrema);
        missed += std::max(0, trueExtrema - one.extrema);
        notMonotone += one.notMonotone;
        typical += one.typical;
        if (each) {
          std::printf("    seed %2d %8.4f %8.3f %8.3f  extrema %d  points %d  %.1f ms %s\n", seed, one.rms, one.max,
                      one.kappa, one.extrema, one.controlPoints, one.ms, one.problem.c_str());
        }
      }
      std::printf("%-16s %8.4f %8.3f %8.3f %9d %9d %7.0f %9.1e %8.1f", method.name.c_str(), median(rms), median(max),
                  median(kappa), extra, missed, median(points), *std::max_element(jump.begin(), jump.end()),
                  median(ms));
      if (typical > 0) std::printf("  %.1f typical, %d not monotone", typical / double(seeds), notMonotone);
      if (failed > 0) std::printf("  %d failed", failed);
      std::printf("\n");
      std::fflush(stdout);
    }
  }
  return 0;
}
