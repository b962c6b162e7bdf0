// SPDX-License-Identifier: GPL-3.0-or-later
// Prints how few control points light curves need, for shapes whose exact course is known, and for drawings.
//
//   bench_light [SAMPLE.png] [--drawings] [--simplified]
//
// First table: nine shapes of 800 x 600 px, at tolerances of 1, 0.5, 0.2 and 0.05 px from the truth itself: control
// points (each once; exact line 2, arc or circle 3), those of a chain of G1 cubics, each as long as it can be, and of
// potrace on a clean page where it is installed (optimum tolerances 5, 1 and 0.2; its own error is 0.4 to 3 px);
// curvature extrema of the light curve and of the truth, largest distance, milliseconds for the whole shape.
// SAMPLE.png: the sample that comes with the program (build/release/share/batten/samples/coupe-side.png): its longest
// line, which is the roof, and all of it, at 0.2 and 0.05 mm.
// --drawings: the drawings in BATTEN_SKETCHES (.png, .jpg), the dense curve beside light ones at 0.05, 0.2 and 1 px,
// and what the detail makes of them.
// --simplified: the same drawings as whole outlines within 3, 6 and 10 px: control points of the sections between
// corners, each by its own degree and counted in full, and of the curves that they are joined to; beside them those of
// the longest cubics between the corners, and of potrace on the same page.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/statistics.h"
#include "core/construct/light/detail_curve.h"
#include "core/construct/light/detail_line.h"
#include "core/construct/light/light_curve.h"
#include "core/curve/corners_inside.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/bench/accuracy_peers.h"
#include "tests/bench/cubic_chain.h"
#include "tests/support/dense_curve.h"
#include "tests/support/render_page.h"
#include "tests/support/truth_shapes.h"

using namespace batten;
using namespace batten::test;

namespace {

constexpr int kArcCountsAs = 3;  // an arc or circle counts as what it takes to draw it

struct Sum {
  int points = 0, before = 0, extrema = 0, asked = 0, dense = 0;
  double worst = 0.0, ms = 0.0, slowest = 0.0;
  int iterations = 0, tries = 0, sections = 0, denseSections = 0;
  std::vector<double> each;  ///< [ms] of every curve.

  double medianMs() const { return each.empty() ? 0.0 : upperMedian(std::vector<double>(each)); }
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
  sum.each.push_back(ms);
  sum.iterations += r.iterations;
  sum.tries += r.tries;
  sum.sections += r.sections;
  sum.denseSections += r.sectionsDense;
  sum.slowest = std::max(sum.slowest, ms);
}

/// Of the clean page; none where potrace is not there.
std::optional<int> potracePoints(const TruthShape& shape, double optimum) {
  const Peer potrace = potraceWith(optimum);
  if (!potrace.missing.empty()) return std::nullopt;
  const Scan page = renderPage(fillCoverage(shape.outline(), 800, 600), 800, 600, cleanPage());
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "batten-bench-light";
  std::filesystem::create_directories(folder);
  const auto pgm = folder / "page.pgm";
  const auto result = writePgm(page.grey, pgm) ? potrace.run(pgm, folder) : std::nullopt;
  std::filesystem::remove_all(folder);
  return result ? std::optional(result->controlPoints) : std::nullopt;
}

void printShapes() {
  for (const double tolerance : {1.0, 0.5, 0.2, 0.05}) {
    std::printf("\n%g px      points   cubics  potrace  extrema  asked  worst px      ms\n", tolerance);
    std::vector<int> points;
    for (const TruthShape& shape : truthShapes(800, 600)) {
      Sum sum;
      int cubics = 0;
      const bool closed = shape.corners.empty();
      for (const TruthPiece& piece : shape.pieces) {
        cubics += cubicChainPoints(piece, closed, tolerance);
        add(sum, denseCurve(piece, closed), closed, tolerance, 0.5);
      }
      const auto potrace = potracePoints(shape, tolerance >= 1.0 ? 5.0 : tolerance >= 0.5 ? 1.0 : 0.2);
      const std::string traced = potrace ? std::to_string(*potrace) : "-";
      std::printf("%-10s %6d %8d %8s %8d %6d %9.3f %7.1f\n", shape.name.c_str(), sum.points, cubics, traced.c_str(),
                  sum.extrema, sum.asked, sum.worst, sum.ms);
      points.push_back(sum.points);
    }
    std::printf("median %10d\n", upperMedian(points));
  }
}

/// The dense curves of a scan; none where it cannot be read.
PipelineOutput denseCurvesOf(const std::filesystem::path& path, bool cornersFound = true) {
  const auto scan = readScan(path, ScanRequest{}, RunContext{});
  if (!scan) return {};
  Recipe recipe;
  recipe.construct.light = false;
  recipe.corners.automatic = cornersFound;
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Curves;
  return runPipeline(*scan, recipe, cache, request, {});
}

/// The roof of the sample, and its other lines.
void printSample(const std::filesystem::path& path) {
  const PipelineOutput out = denseCurvesOf(path);
  if (!out.constructed || out.constructed->curves.empty()) {
    std::printf("\n%s cannot be read, or holds no line.\n", path.string().c_str());
    return;
  }
  const auto& curves = out.constructed->curves;
  const auto shorter = [](const TracedCurve& a, const TracedCurve& b) {
    return a.sketchedFigures.lengthMm < b.sketchedFigures.lengthMm;
  };
  const TracedCurve& roof = *std::max_element(curves.begin(), curves.end(), shorter);
  std::printf("\n");
  for (const double toleranceMm : {0.2, 0.05}) {
    Sum one, all;
    add(one, roof.sketched, roof.closed, toleranceMm, 0.5 * out.frame.mmPerPx);
    for (const TracedCurve& curve : curves)
      add(all, curve.sketched, curve.closed, toleranceMm, 0.5 * out.frame.mmPerPx);
    std::printf(
        "sample %.2f mm: roof of %.0f mm %d -> %d points, %d of %d extrema, %.3f mm off, %.0f ms; all %zu lines %d -> "
        "%d points, %.0f ms\n",
        toleranceMm, roof.sketchedFigures.lengthMm, one.before, one.points, one.extrema, one.asked, one.worst, one.ms,
        curves.size(), all.before, all.points, all.ms);
  }
}

void printDrawing(const std::filesystem::path& path) {
  const PipelineOutput out = denseCurvesOf(path);
  if (!out.constructed) return;
  for (const double tolerancePx : {0.05, 0.2, 1.0}) {
    Sum sum;
    for (const TracedCurve& curve : out.constructed->curves) {
      add(sum, curve.sketched, curve.closed, tolerancePx * out.frame.mmPerPx, 0.5 * out.frame.mmPerPx);
    }
    std::printf(
        "%-30s %5.2f px: %6d -> %5d points, %5d of %5d extrema, %3d of %3zu stay dense, of %d sections %d; ms: %8.0f, "
        "median %5.2f, slowest %5.0f; %d tries, %d iterations\n",
        path.filename().string().c_str(), tolerancePx, sum.before, sum.points, sum.extrema, sum.asked, sum.dense,
        out.constructed->curves.size(), sum.sections, sum.denseSections, sum.ms, sum.medianMs(), sum.slowest, sum.tries,
        sum.iterations);
    std::fflush(stdout);
  }
}

/// Control points of a section between corners as it was found, before it was raised to the degree of the others: a
/// single span has those of its own degree.
int ownPoints(const NurbsCurve& section) {
  std::vector<Vec2> differences(section.controlPoints().begin(), section.controlPoints().end());
  if (static_cast<int>(differences.size()) != section.degree() + 1) return section.controlPointCount();
  const double least = 1e-9 * extent(section);
  int degree = section.degree();
  // The differences of one order more than the degree vanish.
  std::vector<double> largest;
  for (int order = 1; order <= section.degree(); ++order) {
    double most = 0.0;
    for (std::size_t i = 0; i + 1 < differences.size(); ++i) {
      differences[i] = differences[i + 1] - differences[i];
      most = std::max(most, differences[i].norm());
    }
    differences.pop_back();
    largest.push_back(most);
  }
  while (degree > 1 && largest[degree - 1] <= least) --degree;
  return degree + 1;
}

/// The same of all sections of a curve.
int ownPointsOfSections(const NurbsCurve& curve) {
  int points = 0;
  NurbsCurve rest = curve;
  for (const double u : cornersInside(curve)) {
    const auto halves = split(rest, u);
    if (!halves) break;
    points += ownPoints(halves->left);
    rest = halves->right;
  }
  return points + ownPoints(rest);
}

/// The longest cubics between the corners that the simplified curve has, too.
int cubicsBetweenCorners(const NurbsCurve& dense, bool closed, double tolerancePx, double mmPerPx) {
  const EvenLine line = evenLine(dense, closed, 0.5 * mmPerPx);
  std::vector<Vec2> points;
  for (const Vec2& p : line.points) points.push_back(p / mmPerPx);
  const auto corners = cornersAtScale(line, tolerancePx * mmPerPx);
  if (corners.empty()) return cubicChainPoints({points, {}}, closed, tolerancePx);
  if (closed) {
    std::rotate(points.begin(), points.begin() + corners.front().sample, points.end());
    points.push_back(points.front());
  }
  int sum = 0;
  std::size_t from = 0;
  for (std::size_t i = closed ? 1 : 0; i <= corners.size(); ++i) {
    const auto to = i == corners.size() ? points.size() - 1 : corners[i].sample - (closed ? corners.front().sample : 0);
    const std::vector<Vec2> part(points.begin() + static_cast<std::ptrdiff_t>(from),
                                 points.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    if (part.size() > 1) sum += cubicChainPoints({part, {}}, false, tolerancePx);
    from = to;
  }
  return sum;
}

/// Ragged outlines within a tolerance in pixels, whole ones, without corners that were marked or found before: what the
/// control points of a simplified drawing are to be held against.
void printSimplified(const std::filesystem::path& path) {
  const auto scan = readScan(path, ScanRequest{}, RunContext{});
  const PipelineOutput out = denseCurvesOf(path, false);
  if (!scan || !out.constructed) return;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "batten-bench-light";
  std::filesystem::create_directories(folder);
  const Peer potrace = potraceWith(0.2);
  std::optional<TraceResult> traced;
  if (potrace.missing.empty() && writePgm(scan->grey, folder / "page.pgm"))
    traced = potrace.run(folder / "page.pgm", folder);
  std::filesystem::remove_all(folder);
  const double mmPerPx = out.frame.mmPerPx;
  for (const double tolerancePx : {3.0, 6.0, 10.0}) {
    int own = 0, joined = 0, before = 0, corners = 0, extrema = 0, necks = 0, dense = 0, cubics = 0;
    double worst = 0.0;
    const std::clock_t begin = std::clock();
    for (const TracedCurve& curve : out.constructed->curves) {
      LightOptions options;
      options.tolerance = tolerancePx * mmPerPx;
      options.step = 0.5 * mmPerPx;
      const auto simple = simplifiedCurve(curve.sketched, curve.closed, options, {});
      if (!simple || simple->report.kind == LightKind::Dense) {
        ++dense;
        own += curve.sketchedFigures.controlPoints;
        joined += curve.sketchedFigures.controlPoints;
        continue;
      }
      before += simple->report.pointsBefore;
      own += simple->report.kind == LightKind::Chain ? ownPointsOfSections(simple->curve) : simple->report.points;
      joined += simple->report.points;
      corners += simple->report.corners;
      extrema += simple->report.extrema;
      necks += simple->report.necks;
      worst = std::max(worst, simple->report.worst / mmPerPx);
    }
    const double ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    for (const TracedCurve& curve : out.constructed->curves)
      cubics += cubicsBetweenCorners(curve.sketched, curve.closed, tolerancePx, mmPerPx);
    std::printf(
        "%-30s within %4.1f px: %zu outlines, %5d -> %4d points by sections, %4d in one curve each, %4d corners, %4d "
        "extrema, %2d necks, %d stay dense, %5.2f px off, %.0f ms CPU; cubics %d, potrace %s\n",
        path.filename().string().c_str(), tolerancePx, out.constructed->curves.size(), before, own, joined, corners,
        extrema, necks, dense, worst, ms, cubics, traced ? std::to_string(traced->controlPoints).c_str() : "-");
    std::fflush(stdout);
  }
}

/// What the detail makes of a drawing.
void printDetails(const std::filesystem::path& path) {
  const auto scan = readScan(path, ScanRequest{}, RunContext{});
  if (!scan) return;
  StageCache cache;
  for (const double detail : {0.0, 0.5, 0.7, 0.85, 1.0}) {
    Recipe recipe;
    recipe.construct.detail = detail;
    PipelineRequest request;
    request.upTo = StageId::Curves;
    const auto begin = std::chrono::steady_clock::now();
    const PipelineOutput out = runPipeline(*scan, recipe, cache, request, {});
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (!out.constructed) return;
    int points = 0, extrema = 0, corners = 0, dense = 0;
    double tolerance = 0.0, moved = 0.0;
    for (const TracedCurve& curve : out.constructed->curves) {
      extrema += curve.sketchedFigures.extrema;
      points += curve.sketched.isRational() ? kArcCountsAs : curve.sketchedFigures.controlPoints;
      if (!curve.construct.light) continue;
      corners += curve.construct.light->corners;
      dense += curve.construct.light->found ? 0 : 1;
      tolerance = std::max(tolerance, curve.construct.light->tolerancePx);
      moved = std::max(moved, curve.construct.light->movedPx);
    }
    std::printf(
        "%-30s detail %.2f: tolerance to %6.2f px, %5d points, %5d extrema, %4d corners inside, %d of %zu stay "
        "dense, moved by %.2f px at most, %.0f ms\n",
        path.filename().string().c_str(), detail, tolerance, points, extrema, corners, dense,
        out.constructed->curves.size(), moved, ms);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  printShapes();
  if (const Peer potrace = potraceWith(0.2); !potrace.missing.empty()) {
    std::printf("\npotrace: %s\n", potrace.missing.c_str());
  }
  bool wantsDrawings = false, wantsSimplified = false;
  for (const char* argument : std::span(argv, argc).subspan(1)) {
    if (std::string(argument) == "--drawings")
      wantsDrawings = true;
    else if (std::string(argument) == "--simplified")
      wantsSimplified = true;
    else
      printSample(argument);
  }
  if (!wantsDrawings && !wantsSimplified) return 0;
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
  if (wantsSimplified) {
    for (const auto& drawing : drawings) printSimplified(drawing);
  }
  if (!wantsDrawings) return 0;
  for (const auto& drawing : drawings) printDrawing(drawing);
  std::printf("\n");
  for (const auto& drawing : drawings) printDetails(drawing);
  return 0;
}
