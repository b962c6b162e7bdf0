// SPDX-License-Identifier: GPL-3.0-or-later
// Traces every drawing of a folder with the default recipe and prints, per drawing, how much of the ink the curves
// explain, how much of their length has no ink under it, how many curves and control points there are, and the time;
// where a file of the same name with the ending .svg says how the drawing was made, also how far the curves are from
// it. Into OVERLAY_FOLDER it writes the curves over the scan, with missed ink in blue, and a page index.html to look
// at.
//
//   bench_sketches FOLDER [OVERLAY_FOLDER] [--groups] [stage.parameter=value …]
//
// --groups says for every meant line that was not found as one line which lines were found on it, and for every
// drawing where curves have no ink under them.

#include <QColor>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "core/contour/corner/corner_suggestions.h"
#include "core/curve/arc_length.h"
#include "core/document/explain/explanation.h"
#include "core/image/file/scan_reader.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/corner_places.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/bench/sketch_truth.h"

using namespace batten;
namespace fs = std::filesystem;

namespace {

struct Figures {
  int curves = 0, controlPoints = 0, failures = 0, extrema = 0;
  double worstRmsPx = 0.0;
  std::vector<test::CurvePoint> points;
  std::vector<std::vector<test::CurvePoint>> lines;
};

// Missed ink in blue, below the curves.
void paintMissed(const BitImage& missed, QImage& overlay, double scale) {
  for (int y = 0; y < overlay.height(); ++y) {
    for (int x = 0; x < overlay.width(); ++x) {
      if (missed.at(static_cast<int>(x / scale), static_cast<int>(y / scale)))
        overlay.setPixel(x, y, qRgb(60, 110, 255));
    }
  }
}

Figures drawAndMeasure(const PipelineOutput& output, QImage& overlay, double scale) {
  Figures figures;
  QPainter painter(&overlay);
  painter.setRenderHint(QPainter::Antialiasing);
  int hue = 0;
  for (const TracedCurve& curve : output.faired->curves) {
    const int count = std::max(8, static_cast<int>(output.frame.lengthToImage(curve.sketchedFigures.lengthMm)));
    QPainterPath path;
    Vec2 last = Vec2::Zero();
    std::vector<test::CurvePoint> line;
    for (const CurveSample& sample : sampleByArcLength(curve.faired, count)) {
      const Vec2 p = output.frame.pointToImage(sample.point);
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
    figures.worstRmsPx = std::max(figures.worstRmsPx, output.frame.lengthToImage(curve.fairedFigures.fromPoints.rms));
  }
  painter.setPen(QPen(QColor(220, 60, 20), 2));
  for (const Corner& corner : output.pieces->corners)
    painter.drawRect(QRectF(corner.positionPx.x() * scale - 4, corner.positionPx.y() * scale - 4, 8, 8));
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
    const std::vector<Vec2> p = positionsOf(pieces->pieces[i].points);
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

// One drawing of the table.
struct Row {
  std::string file;
  Explanation explanation;
  int curves = 0, controlPoints = 0;
  double seconds = 0.0;
};

void writePage(const fs::path& folder, const std::vector<Row>& rows) {
  std::ofstream html(folder / "index.html");
  html << "<!DOCTYPE html><meta charset=utf-8><title>Curves over their drawings</title>\n"
          "<style>body{font-family:sans-serif}td,th{padding:2px 10px;text-align:right}td:first-child{text-align:left}"
          "img{max-width:100%;border:1px solid #ccc}</style>\n<table><tr><th>drawing<th>explained %<th>missed %"
          "<th>invented %<th>curves<th>control points<th>seconds</tr>\n";
  const auto name = [](const Row& row) { return QString::fromStdString(row.file).toHtmlEscaped().toStdString(); };
  for (const Row& row : rows) {
    char text[200];
    std::snprintf(text, sizeof text, "<td>%.1f<td>%.1f<td>%.2f<td>%d<td>%d<td>%.1f</tr>\n",
                  100.0 * row.explanation.explained, 100.0 * row.explanation.missed, 100.0 * row.explanation.invented,
                  row.curves, row.controlPoints, row.seconds);
    html << "<tr><td><a href=\"#" << name(row) << "\">" << name(row) << "</a>" << text;
  }
  html << "</table>\n";
  for (const Row& row : rows) {
    html << "<h2 id=\"" << name(row) << "\">" << name(row) << "</h2>\n<img loading=lazy src=\""
         << fs::path(name(row)).stem().string() << "-overlay.png\">\n";
  }
}

std::optional<Row> trace(const fs::path& file, const Recipe& recipe, const fs::path& overlays, bool detailed) {
  const auto scan = readScan(file, {}, {});
  if (!scan) {
    std::printf("%-30s %s\n", file.filename().c_str(), scan.error().message.c_str());
    return {};
  }
  StageCache cache;
  const auto begin = std::chrono::steady_clock::now();
  const PipelineOutput output = runPipeline(*scan, recipe, cache, {}, {});
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  if (!output.faired) {
    std::printf("%-30s %s\n", file.filename().c_str(), output.error ? output.error->message.c_str() : "no result");
    return {};
  }
  const auto explanation = explainPage(*scan, recipe, output, {});
  if (!explanation) {
    std::printf("%-30s %s\n", file.filename().c_str(), explanation.error().message.c_str());
    return {};
  }
  const double scale = std::clamp(1500.0 / scan->grey.width, 0.4, 3.0);
  QImage overlay = faded(scan->grey, scale);
  paintMissed(explanation->missedInk, overlay, scale);
  Figures f = drawAndMeasure(output, overlay, scale);
  f.failures = static_cast<int>(output.constructed->failures.size());
  std::printf(
      "%-30s explained %5.1f %%  missed %5.1f %%  invented %5.2f %%  %5d curves %6d points %5d extrema  worst rms %.2f "
      "px  %d failed  %7.0f ms\n",
      file.filename().c_str(), 100.0 * explanation->explained, 100.0 * explanation->missed,
      100.0 * explanation->invented, f.curves, f.controlPoints, f.extrema, f.worstRmsPx, f.failures, ms);
  if (detailed) {
    for (const InventedStretch& s : explanation->inventions)
      std::printf("      invented %6.1f px of curve %d from (%.0f, %.0f)\n", s.lengthPx, s.curve + 1,
                  s.linePx.front().x(), s.linePx.front().y());
  }
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
  return Row{file.filename().string(), *explanation, f.curves, f.controlPoints, 0.001 * ms};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || !fs::is_directory(argv[1])) {
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
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".tif" || ending == ".pgm")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Row> rows;
  for (const fs::path& file : files) {
    if (auto row = trace(file, recipe, overlays, detailed)) rows.push_back(std::move(*row));
  }
  double explained = 0.0, invented = 0.0;
  for (const Row& row : rows) {
    explained += row.explanation.explained / static_cast<double>(rows.size());
    invented += row.explanation.invented / static_cast<double>(rows.size());
  }
  std::printf("%-30s explained %5.1f %%  invented %5.2f %%\n", "mean", 100.0 * explained, 100.0 * invented);
  if (!overlays.empty()) writePage(overlays, rows);
  return 0;
}
