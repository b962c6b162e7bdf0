// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/stroke_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/contour/trace_contours.h"
#include "tests/support/end_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using test::EndPage;
using test::EndTruth;
using test::StrokeEnd;

struct EndError {
  double shortPx = std::numeric_limits<double>::infinity();  // along the stroke; negative: too long
  double asidePx = 0.0;
};

// Over all ends of a page: the shortest, the longest and the farthest aside, and how far nine in ten are off at most.
struct WorstEnds {
  double shortPx = 0.0, longPx = 0.0, asidePx = 0.0, mostlyPx = 0.0;
  int strokes = 0;
};

EndError errorAt(const EndTruth& truth, const ContourSet& set) {
  EndError error;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Contour& c : set.contours) {
    for (const Vec2& at : {c.points.front().at, c.points.back().at}) {
      const Vec2 off = truth.at - at;
      if (off.norm() >= nearest) continue;
      nearest = off.norm();
      error = {off.dot(truth.out), std::abs(off.x() * truth.out.y() - off.y() * truth.out.x())};
    }
  }
  return error;
}

WorstEnds worstEnds(StrokeEnd kind, double widthPx, const test::PageStyle& style) {
  const EndPage page = test::endPage(kind, widthPx);
  const Scan scan = test::renderPage(page.coverage, page.width, page.height, style);
  BitImage ink(page.width, page.height);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      const double paper = style.paperLeft + (style.paperRight - style.paperLeft) * x / page.width;
      ink.set(x, y, scan.grey.level(x, y) < 0.5 * (paper + style.inkLevel));
    }
  }
  EdgeParams edges;
  edges.mode = EdgeMode::Centreline;
  const auto set = traceContours(ink, scan.grey, edges, {}, {});
  WorstEnds worst;
  if (!set) return worst;
  worst.strokes = static_cast<int>(set->contours.size());
  std::vector<double> off;
  for (const EndTruth& truth : page.ends) {
    const EndError error = errorAt(truth, *set);
    off.push_back(std::abs(error.shortPx));
    worst.shortPx = std::max(worst.shortPx, error.shortPx);
    worst.longPx = std::max(worst.longPx, -error.shortPx);
    worst.asidePx = std::max(worst.asidePx, error.asidePx);
  }
  std::sort(off.begin(), off.end());
  worst.mostlyPx = off[off.size() * 9 / 10];
  return worst;
}

constexpr double kWidthsPx[] = {2.0, 3.0, 5.0, 8.0, 12.0};

struct EndScan {
  std::string name;
  test::PageStyle style;
  double tellsFromPx;  // strokes this wide show what kind of end they have
  // Thinner ones are in pieces where blur leaves them paler than half the contrast; sharp ones are taken for pencil, of
  // which a line ends where it is last seen.
  double thinnestTaperPx;
};
std::vector<EndScan> scans() {
  return {{"clean", test::cleanPage(), 3.0, 3.0},
          {"scan", test::scannedPage(3), 5.0, 2.0},
          {"blurred", test::gradatedPage(7), 5.0, 3.0}};
}

// Within half a pixel where the scan shows a cut or a cap; thinner strokes end between the two.
void expectStops(const WorstEnds& worst, double width, const EndScan& scan, const char* kind) {
  const std::string what = scan.name + ", " + std::to_string(width) + ", " + kind;
  EXPECT_EQ(worst.strokes, 12) << what;
  EXPECT_LE(worst.shortPx, 0.5 * width + 0.3) << what;
  EXPECT_LE(worst.longPx, 0.5 * width + 0.3) << what;
  EXPECT_LE(worst.asidePx, 0.5) << what;
  if (width >= scan.tellsFromPx) {
    EXPECT_LE(worst.mostlyPx, 0.5) << what;
  }
}

TEST(StrokeEnds, ALineReachesTheEndOfAStrokeCutOffSquareOrSkewed) {
  for (const double width : kWidthsPx) {
    for (const EndScan& scan : scans()) {
      expectStops(worstEnds(StrokeEnd::Butt, width, scan.style), width, scan, "square");
      expectStops(worstEnds(StrokeEnd::Skewed, width, scan.style), width, scan, "skewed");
    }
  }
}

TEST(StrokeEnds, ALineEndsInTheCentreOfARoundCap) {
  for (const double width : kWidthsPx) {
    for (const EndScan& scan : scans())
      expectStops(worstEnds(StrokeEnd::Round, width, scan.style), width, scan, "round");
  }
}

TEST(StrokeEnds, ALineReachesTheTipOfAStrokeThatThinsToNothing) {
  for (const double width : kWidthsPx) {
    for (const EndScan& scan : scans()) {
      if (width < scan.thinnestTaperPx) continue;
      const WorstEnds worst = worstEnds(StrokeEnd::Taper, width, scan.style);
      EXPECT_EQ(worst.strokes, 12) << scan.name << ", " << width;
      EXPECT_LE(worst.shortPx, 2.0) << scan.name << ", " << width;
      EXPECT_LE(worst.longPx, 2.0) << scan.name << ", " << width;
      EXPECT_LE(worst.asidePx, 1.3) << scan.name << ", " << width;
      EXPECT_LE(worst.mostlyPx, 1.3) << scan.name << ", " << width;
    }
  }
}

}  // namespace
}  // namespace batten
