// SPDX-License-Identifier: GPL-3.0-or-later
// Traces every drawing of a folder with the default recipe and prints, per drawing, how much of the curves lies on ink,
// how much of the ink has a curve, and how many curves and control points there are; where a file of the same name with
// the ending .svg says how the drawing was made, also how far the curves are from it. Writes the curves over the scan.
//
//   bench_sketches FOLDER [OVERLAY_FOLDER] [--groups] [stage.parameter=value …]
//
// --groups says for every meant line that was not found as one line which lines were found on it.

#include <QColor>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/curve/arc_length.h"
#include "core/image/laplacian_edges.h"
#include "core/image/scan_reader.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/corner_places.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/bench/sketch_truth.h"

using namespace batten;
namespace fs = std::filesystem;

namespace {

constexpr double kOnInkPx = 2.0;

/// Distance of every pixel's centre to the nearest ink pixel's centre.
cv::Mat distanceToInk(const BitImage& ink) {
  cv::Mat paper(ink.height, ink.width, CV_8U);
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) paper.at<unsigned char>(y, x) = ink.at(x, y) ? 0 : 255;
  cv::Mat distance;
  cv::distanceTransform(paper, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

/// Half the stroke that a curve runs along; 0 on the border of ink.
double halfWidthOf(const Contour& contour) {
  std::vector<float> widths = strokeWidthsOf(contour.points);
  if (widths.empty()) return 0.0;
  const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
  std::nth_element(widths.begin(), middle, widths.end());
  return 0.5 * static_cast<double>(*middle);
}

/// Share of the border of the ink, as thresholds find it, that lies within `reached`.
double shareReached(const BitImage& ink, const cv::Mat& reached) {
  const auto edges = laplacianEdges(ink, {});
  double in = 0.0, all = 0.0;
  for (int y = 0; edges && y < edges->height; ++y) {
    for (int x = 0; x < edges->width; ++x) {
      if (!edges->at(x, y)) continue;
      all += 1.0;
      in += reached.at<unsigned char>(y, x) != 0 ? 1.0 : 0.0;
    }
  }
  return all > 0.0 ? in / all : 0.0;
}

struct Figures {
  int curves = 0, controlPoints = 0, failures = 0, extrema = 0;
  double lengthPx = 0.0, onInk = 0.0, traced = 0.0, worstRmsPx = 0.0;
  std::vector<test::CurvePoint> points;
  std::vector<std::vector<test::CurvePoint>> lines;
};

Figures drawAndMeasure(const PipelineOutput& output, QImage& overlay, double scale) {
  Figures figures;
  QPainter painter(&overlay);
  painter.setRenderHint(QPainter::Antialiasing);
  const cv::Mat distance = distanceToInk(*output.binary);
  cv::Mat reached = cv::Mat::zeros(distance.size(), CV_8U);
  double on = 0.0, all = 0.0;
  int hue = 0;
  for (const TracedCurve& curve : output.faired->curves) {
    const int count = std::max(8, static_cast<int>(output.frame.lengthToImage(curve.sketchedFigures.lengthMm)));
    const double reach = kOnInkPx + halfWidthOf(output.contours->contours[curve.contour]) + 0.5;
    QPainterPath path;
    Vec2 last = Vec2::Zero();
    std::vector<test::CurvePoint> line;
    for (const CurveSample& sample : sampleByArcLength(curve.faired, count)) {
      const Vec2 p = output.frame.pointToImage(sample.point);
      const int x = std::clamp(static_cast<int>(p.x()), 0, distance.cols - 1),
                y = std::clamp(static_cast<int>(p.y()), 0, distance.rows - 1);
      on += distance.at<float>(y, x) <= kOnInkPx ? 1.0 : 0.0;
      all += 1.0;
      cv::circle(reached, {x, y}, static_cast<int>(std::ceil(reach)), 255, cv::FILLED);
      const QPointF q(p.x() * scale, p.y() * scale);
      if (path.elementCount() > 0 && p != last) line.push_back({0.5 * (p + last), (p - last).normalized()});
      last = p;
      path.elementCount() == 0 ? path.moveTo(q) : path.lineTo(q);
    }
    painter.setPen(QPen(QColor::fromHsv(hue, 255, 210), 1.3));
    painter.drawPath(path);
    hue = (hue + 83) % 360;
    figures.points.insert(figures.points.end(), line.begin(), line.end());
    figures.lines.push_back(std::move(line));
    ++figures.curves;
    figures.controlPoints += curve.faired.controlPointCount();
    figures.extrema += curve.fairedFigures.extrema;
    figures.lengthPx += count;
    figures.worstRmsPx = std::max(figures.worstRmsPx, output.frame.lengthToImage(curve.fairedFigures.fromPoints.rms));
  }
  painter.setPen(QPen(QColor(220, 60, 20), 2));
  for (const Corner& corner : output.pieces->corners)
    painter.drawRect(QRectF(corner.positionPx.x() * scale - 4, corner.positionPx.y() * scale - 4, 8, 8));
  figures.onInk = all > 0 ? on / all : 0.0;
  figures.traced = shareReached(*output.binary, reached);
  return figures;
}

QImage faded(const GreyImage& grey, double scale) {
  QImage image(grey.width, grey.height, QImage::Format_RGB32);
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) {
      const int v = 90 + static_cast<int>(grey.level(x, y) * 165 / 255);
      image.setPixel(x, y, qRgb(v, v, v));
    }
  return image.scaled(static_cast<int>(grey.width * scale), static_cast<int>(grey.height * scale),
                      Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

// The lines cut at the corners that the program would suggest: what was drawn from corner to corner.
std::vector<std::vector<test::CurvePoint>> cornerToCorner(const ContourSet& contours) {
  constexpr double kAngleRad = 0.61, kScalePx = 16.0;  // 35 degrees, as in the window
  std::vector<CornerMark> marks;
  for (const CornerSuggestion& s : suggestCornersAndCuts(contours, kAngleRad, kScalePx, {}))
    marks.push_back({s.positionPx, 0.0});
  std::vector<std::vector<test::CurvePoint>> lines;
  const auto pieces = splitAtCorners(contours, marks, {}, {});
  for (std::size_t i = 0; pieces && i < pieces->pieces.size(); ++i) {
    std::vector<test::CurvePoint> line;
    const auto& p = pieces->pieces[i].points;
    for (std::size_t k = 0; k + 1 < p.size(); ++k)
      if (p[k] != p[k + 1]) line.push_back({0.5 * (p[k] + p[k + 1]), (p[k + 1] - p[k]).normalized()});
    if (!line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

void printGrouping(const char* what, const test::SketchTruth& truth,
                   const std::vector<std::vector<test::CurvePoint>>& lines, int meant, bool detailed) {
  const test::SketchTruth::Grouping g = truth.group(lines);
  std::printf(
      "%-30s %5zu found of %d meant; %d matched, %d covered by one line; found: %d on one line, %d on several\n", what,
      lines.size(), meant, g.matched, g.covered, g.onOne, g.divided);
  for (std::size_t i = 0; detailed && i < g.unmatched.size(); ++i) std::printf("      %s\n", g.unmatched[i].c_str());
}

void trace(const fs::path& file, const Recipe& recipe, const fs::path& overlays, bool detailed) {
  const auto scan = readScan(file, {}, {});
  if (!scan) {
    std::printf("%-30s %s\n", file.filename().c_str(), scan.error().message.c_str());
    return;
  }
  StageCache cache;
  const auto begin = std::chrono::steady_clock::now();
  const PipelineOutput output = runPipeline(*scan, recipe, cache, {}, {});
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (!output.faired) {
    std::printf("%-30s %s\n", file.filename().c_str(), output.error ? output.error->message.c_str() : "no result");
    return;
  }
  const double scale = std::clamp(1500.0 / scan->grey.width, 0.4, 3.0);
  QImage overlay = faded(scan->grey, scale);
  Figures f = drawAndMeasure(output, overlay, scale);
  f.failures = static_cast<int>(output.constructed->failures.size());
  std::printf(
      "%-30s %5d curves %6d points %5d extrema %8.0f px  on ink %5.1f %%  ink traced %5.1f %%  worst rms %.2f px  %d "
      "failed  %7.0f ms\n",
      file.filename().c_str(), f.curves, f.controlPoints, f.extrema, f.lengthPx, 100.0 * f.onInk, 100.0 * f.traced,
      f.worstRmsPx, f.failures, ms);
  if (const auto truth = test::SketchTruth::beside(file, scan->grey.width, scan->grey.height)) {
    const test::SketchTruth::Figures t = truth->compare(f.points);
    std::printf(
        "%-30s %5d lines were meant; curves off them median %.2f, rms %.2f px, %.1f %% on none; covered %.1f %%\n",
        "  as it was drawn", t.groups, t.medianPx, t.rmsPx, 100.0 * t.unmatched, 100.0 * t.covered);
    printGrouping("  lines", *truth, f.lines, t.groups, false);
    printGrouping("  from corner to corner", *truth, cornerToCorner(*output.contours), t.groups, detailed);
  }
  std::fflush(stdout);
  if (!overlays.empty())
    overlay.save(QString::fromStdString((overlays / (file.stem().string() + "-overlay.png")).string()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: bench_sketches FOLDER [OVERLAY_FOLDER] [--groups] [stage.parameter=value …]\n", stderr);
    return 2;
  }
  Recipe recipe;
  fs::path overlays;
  bool detailed = false;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.empty()) continue;
    if (word == "--groups") {
      detailed = true;
      continue;
    }
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
      if (word.front() == '-') {
        std::fprintf(stderr, "%s is no option; settings are given as stage.parameter=value\n", word.c_str());
        return 2;
      }
      overlays = word;
      fs::create_directories(overlays);
    } else if (const auto done = setParameter(recipe, word.substr(0, equals), word.substr(equals + 1)); !done) {
      std::fprintf(stderr, "%s\n", done.error().message.c_str());
      return 2;
    }
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".png" || ending == ".jpg" || ending == ".tif" || ending == ".pgm") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) trace(file, recipe, overlays, detailed);
  return 0;
}
