// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/width_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/curve/arc_length.h"
#include "core/document/export_builder.h"
#include "core/exchange/export_file.h"
#include "core/exchange/model/width_distance.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/svg/svg_shapes.h"
#include "tests/support/render_page.h"
#include "tests/support/svg_paths.h"
#include "tests/support/width_page.h"

namespace batten {
namespace {

using Polygon = std::vector<Vec2>;

/// The borders of an outline as polygons: read by the tests' own eyes.
std::vector<Polygon> polygonsOf(const WidthOutline& outline) {
  std::vector<Polygon> all;
  for (const CubicRun& loop : outline.loops) {
    Polygon& polygon = all.emplace_back();
    Vec2 from = loop.start;
    for (const auto& c : loop.cubics) {
      const test::SvgCubic cubic{{from, c[0], c[1], c[2]}};
      for (int k = 0; k < 12; ++k) polygon.push_back(cubic.at(k / 12.0));
      from = c[2];
    }
  }
  return all;
}

double signedArea(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

double areaOf(const WidthOutline& outline) {
  double area = 0.0;
  for (const Polygon& polygon : polygonsOf(outline)) area += signedArea(polygon);
  return area;
}

/// The integral of the width, and two half discs at the ends.
double inkOf(const ExportCurve& line) {
  double area = 0.0;
  for (const ExportPiece& piece : line.pieces) area += figuresOf(*piece.width).mean * piece.width->length();
  if (line.closed) return area;
  const double a = line.pieces.front().width->samples.front().width, b = line.pieces.back().width->samples.back().width;
  return area + std::numbers::pi / 8.0 * (a * a + b * b);
}

bool doCross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

int crossingsOf(const Polygon& p) {
  int count = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = i + 2; k < p.size(); ++k)
      if (!(i == 0 && k + 1 == p.size()) && doCross(p[i], p[i + 1], p[k], p[(k + 1) % p.size()])) ++count;
  return count;
}

NurbsCurve polyline(const std::vector<Vec2>& points) {
  std::vector<double> knots{0.0};
  for (std::size_t i = 0; i < points.size(); ++i) knots.push_back(static_cast<double>(i));
  knots.push_back(static_cast<double>(points.size()) - 1.0);
  return NurbsCurve::make(1, knots, points).value();
}

ExportPiece pieceOf(const NurbsCurve& curve, double from, double to) {
  ExportPiece piece{curve};
  piece.width = WidthProfile{{{0.0, from}, {ArcLength(curve).total(), to}}, 0.0};
  return piece;
}

std::vector<std::array<Vec2, 4>> cubicsOf(const WidthOutline& outline) {
  std::vector<std::array<Vec2, 4>> all;
  for (const CubicRun& loop : outline.loops) {
    Vec2 from = loop.start;
    for (const auto& c : loop.cubics) {
      all.push_back({from, c[0], c[1], c[2]});
      from = c[2];
    }
  }
  return all;
}

TEST(WidthOutline, OfAStraightTaperIsWhatGeometrySays) {
  ExportCurve line{"curve-1", false, {pieceOf(polyline({{10, 10}, {50, 10}}), 4.0, 0.0)}};
  const WidthOutline outline = widthOutline(line, 1e-4);
  ASSERT_EQ(outline.loops.size(), 1u);
  EXPECT_NEAR(areaOf(outline), 80.0 + std::numbers::pi * 2.0, 0.01);
  EXPECT_LE(outline.cubics, 8);
  EXPECT_LT(distanceFromWidth(cubicsOf(outline), line), 1e-3);
  bool hasTip = false;
  for (const auto& cubic : cubicsOf(outline)) hasTip = hasTip || (cubic[3] - Vec2(50, 10)).norm() < 1e-9;
  EXPECT_TRUE(hasTip);
}

TEST(WidthOutline, OfACornerIsRoundOutsideAndSharpInside) {
  for (const double angle : {0.6, 1.2, 1.57, 2.2, 2.7}) {
    for (const double way : {1.0, -1.0}) {
      const Vec2 corner(40, 0), end = corner + 40.0 * Vec2(std::cos(angle), way * std::sin(angle));
      ExportCurve line{"curve-1",
                       false,
                       {pieceOf(polyline({{0, 0}, corner}), 3.0, 3.0), pieceOf(polyline({corner, end}), 3.0, 3.0)}};
      const WidthOutline outline = widthOutline(line, 1e-4);
      ASSERT_EQ(outline.loops.size(), 1u);
      EXPECT_EQ(crossingsOf(polygonsOf(outline)[0]), 0) << angle * way;
      // Two strips, less what both cover at the corner, and a sector outside; two half discs at the ends.
      const double half = 1.5, kite = half * half * std::tan(0.5 * angle), sector = 0.5 * half * half * angle;
      EXPECT_NEAR(areaOf(outline), 240.0 - kite + sector + std::numbers::pi * half * half, 0.02) << angle * way;
      EXPECT_LT(distanceFromWidth(cubicsOf(outline), line), 2e-3) << angle * way;
    }
  }
}

TEST(WidthOutline, ATurnTighterThanHalfTheWidthLeavesNoLoop) {
  // A hairpin that turns more tightly than half of the two larger widths.
  const auto curve = NurbsCurve::make(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {24, 0}, {24, 3}, {0, 14}}).value();
  for (const double width : {0.5, 2.0, 4.0}) {
    ExportCurve line{"curve-1", false, {pieceOf(curve, width, width)}};
    const WidthOutline outline = widthOutline(line, 1e-3);
    ASSERT_EQ(outline.loops.size(), 1u);
    EXPECT_EQ(crossingsOf(polygonsOf(outline)[0]), 0) << width;
    EXPECT_LT(distanceFromWidth(cubicsOf(outline), line), 5e-3) << width;
  }
}

TEST(WidthOutline, OfARingHasTwoBordersAgainstEachOther) {
  for (const bool clockwise : {false, true}) {
    std::vector<Vec2> points;
    for (int i = 0; i <= 360; ++i) {
      const double t = (clockwise ? -1.0 : 1.0) * i * std::numbers::pi / 180.0;
      points.emplace_back(20.0 * std::cos(t), 20.0 * std::sin(t));
    }
    points.back() = points.front();
    ExportCurve line{"curve-1", true, {pieceOf(polyline(points), 2.0, 2.0)}};
    const WidthOutline outline = widthOutline(line, 1e-3);
    ASSERT_EQ(outline.loops.size(), 2u);
    const auto polygons = polygonsOf(outline);
    EXPECT_LT(signedArea(polygons[0]) * signedArea(polygons[1]), 0.0);
    EXPECT_NEAR(areaOf(outline), std::numbers::pi * (21.0 * 21.0 - 19.0 * 19.0), 0.2);
  }
}

TEST(WidthOutline, LinesWithoutAWidthHaveNone) {
  ExportCurve line{"curve-1", false, {ExportPiece{polyline({{0, 0}, {9, 0}})}}};
  EXPECT_TRUE(widthOutline(line, 1e-3).loops.empty());
}

/// What was traced of the page of strokes, as one wants it in an SVG.
struct TracedWidths {
  std::vector<float> coverage = test::widthCoverage(test::widthStrokes());
  ExportDocument document;

  explicit TracedWidths(const test::PageStyle& style) {
    const Scan scan = test::renderPage(coverage, test::kWidthPagePx, test::kWidthPagePx, style);
    Recipe recipe;
    recipe.edges.mode = EdgeMode::Centreline;
    StageCache cache;
    document = exportDocument(runPipeline(scan, recipe, cache, {}, {}), recipe, scan);
  }
};

TEST(WidthOutline, OfAScannedPageIsItsInk) {
  for (const auto& style : {test::cleanPage(), test::scannedPage(5)}) {
    const TracedWidths traced(style);
    ASSERT_EQ(traced.document.curves.size(), 4u);
    ExportSettings settings;
    settings.widthOutlines = true;
    const auto file = exportedFile(traced.document, settings);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->report.outlines, 4);
    EXPECT_LT(file->report.largestWidthErrorMm, 1.2 * defaultTolerance(settings));
    EXPECT_NE(sentenceOf(file->report).find("4 strokes outlined within"), std::string::npos);
    // The file, read by the tests' own reader and drawn over the page.
    std::vector<float> drawn(traced.coverage.size(), 0.0f);
    const double scale = test::kWidthPagePx / test::svgWidthPx(file->bytes);
    std::vector<std::vector<float>> rings;
    for (const test::SvgPath& path : test::readSvgPaths(file->bytes)) {
      if (!path.group.starts_with("widths")) continue;
      Polygon polygon;
      for (const test::SvgCubic& cubic : path.segments)
        for (int k = 0; k < 12; ++k) polygon.push_back(scale * cubic.at(k / 12.0));
      const auto own = test::fillCoverage(polygon, test::kWidthPagePx, test::kWidthPagePx);
      // The two borders of a ring are the only ones of which one lies in the other.
      for (std::size_t i = 0; i < own.size(); ++i) drawn[i] = std::abs(drawn[i] - own[i]);
    }
    double both = 0.0, either = 0.0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      both += std::min(drawn[i], traced.coverage[i]);
      either += std::max(drawn[i], traced.coverage[i]);
    }
    EXPECT_GE(both / either, 0.97);
    // Batten reads its curves back, and takes the outlines for what they are: pictures.
    const auto own = readSvg(file->bytes);
    ASSERT_TRUE(own);
    EXPECT_EQ(own->curves.size(), 4u);
    const auto shapes = readSvgShapes(file->bytes);
    ASSERT_TRUE(shapes);
    EXPECT_EQ(shapes->lines.size(), 4u);
    settings.widthOutlines = false;
    EXPECT_EQ(exportedFile(traced.document, settings)->bytes.find("width-of"), std::string::npos);
    for (const ExportCurve& line : traced.document.curves)
      EXPECT_NEAR(areaOf(widthOutline(line, 0.002)) / inkOf(line), 1.0, 0.01) << line.id;
  }
}

}  // namespace
}  // namespace batten
