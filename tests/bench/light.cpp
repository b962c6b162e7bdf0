// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how few control points light curves need, for shapes whose exact course is known, and for drawings.
//
//   bench_light [--drawings]
//
// First table: nine shapes of 800 x 600 px, at tolerances of 1, 0.5, 0.2 and 0.05 px from the truth itself: control
// points (each once; exact line 2, arc or circle 3), curvature extrema of the light curve and of the truth, largest
// distance, milliseconds for the whole shape. --drawings: the drawings in BATTEN_SKETCHES (.png, .jpg), the dense
// curve beside light ones at 0.05, 0.2 and 1 px.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/construct/light/light_curve.h"
#include "core/curve/uniform_quintic.h"
#include "core/image/scan_reader.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/truth_shapes.h"

using namespace batten;
using namespace batten::test;

namespace {

std::optional<NurbsCurve> denseCurve(const TruthPiece& piece, bool closed) {
  std::vector<double> t(1, 0.0);
  for (std::size_t i = 1; i < piece.points.size(); ++i) {
    t.push_back(t.back() + (piece.points[i] - piece.points[i - 1]).norm());
  }
  const double length = t.back() + (closed ? (piece.points.front() - piece.points.back()).norm() : 0.0);
  std::vector<double> weights(t.size(), 1.0);
  if (!closed) weights.front() = weights.back() = 1e6;
  const UniformKnots knots{length, std::max(6, static_cast<int>(std::lround(length / 6.0))), closed};
  const auto fitted = fitUniformQuintic(knots, t, piece.points, weights, 1e-9);
  if (!fitted) return std::nullopt;
  auto curve = fitted->toNurbs(1.0, 1.0, Vec2::Zero(), Vec2::Zero());
  return curve ? std::optional(*curve) : std::nullopt;
}

struct Sum {
  int points = 0, before = 0, extrema = 0, asked = 0, dense = 0;
  double worst = 0.0, ms = 0.0, slowest = 0.0;
};

void add(Sum& sum, const NurbsCurve& curve, bool closed, double tolerance, double step) {
  LightOptions options;
  options.tolerance = tolerance;
  options.step = step;
  const auto begin = std::chrono::steady_clock::now();
  const auto light = makeLight(curve, closed, options, {});
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (!light) return;
  const LightReport& r = light->report;
  sum.points += r.points;
  sum.before += r.pointsBefore;
  sum.extrema += r.extrema;
  sum.asked += r.extremaAsked;
  sum.dense += r.kind == LightKind::Dense ? 1 : 0;
  sum.worst = std::max(sum.worst, r.worst);
  sum.ms += ms;
  sum.slowest = std::max(sum.slowest, ms);
}

void printShapes() {
  for (const double tolerance : {1.0, 0.5, 0.2, 0.05}) {
    std::printf("\n%g px      points  extrema  asked  worst px      ms\n", tolerance);
    std::vector<int> points;
    for (const TruthShape& shape : truthShapes(800, 600)) {
      Sum sum;
      const bool closed = shape.corners.empty();
      for (const TruthPiece& piece : shape.pieces) {
        if (const auto dense = denseCurve(piece, closed)) add(sum, *dense, closed, tolerance, 0.5);
      }
      std::printf("%-10s %6d %8d %6d %9.3f %7.1f\n", shape.name.c_str(), sum.points, sum.extrema, sum.asked, sum.worst,
                  sum.ms);
      points.push_back(sum.points);
    }
    std::sort(points.begin(), points.end());
    std::printf("median %10d\n", points[points.size() / 2]);
  }
}

void printDrawing(const std::filesystem::path& path) {
  const auto scan = readScan(path, ScanRequest{}, RunContext{});
  if (!scan) return;
  Recipe recipe;
  recipe.construct.light = false;
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Curves;
  const PipelineOutput out = runPipeline(*scan, recipe, cache, request, {});
  if (!out.constructed) return;
  for (const double tolerancePx : {0.05, 0.2, 1.0}) {
    Sum sum;
    for (const TracedCurve& curve : out.constructed->curves) {
      add(sum, curve.sketched, curve.closed, tolerancePx * out.frame.mmPerPx, 0.5 * out.frame.mmPerPx);
    }
    std::printf(
        "%-34s %5.2f px: %6d -> %5d points, %5d of %5d extrema, %3d of %3zu stay dense, %8.0f ms, slowest %6.0f\n",
        path.filename().string().c_str(), tolerancePx, sum.before, sum.points, sum.extrema, sum.asked, sum.dense,
        out.constructed->curves.size(), sum.ms, sum.slowest);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  printShapes();
  if (argc < 2 || std::string(argv[1]) != "--drawings") return 0;
  const char* folder = std::getenv("BATTEN_SKETCHES");
  if (folder == nullptr) {
    std::printf("\nBATTEN_SKETCHES is not set: no drawings.\n");
    return 0;
  }
  std::vector<std::filesystem::path> drawings;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".png" || ending == ".jpg") drawings.push_back(entry.path());
  }
  std::sort(drawings.begin(), drawings.end());
  std::printf("\n");
  for (const auto& drawing : drawings) printDrawing(drawing);
  return 0;
}
