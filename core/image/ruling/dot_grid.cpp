// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/dot_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "core/base/statistics.h"
#include "core/image/plane.h"
#include "core/image/ruling/dot_lattice.h"
#include "core/image/ruling/dot_marks.h"

namespace batten {
namespace {

constexpr std::int64_t kLargestDottedPx = 4'000'000;  // [px] of the shrunk page: bounds the time
constexpr int kFewestDots = 60;                       // without a stroke near by
constexpr double kLeastOfPage = 0.3;                  // that they cover
constexpr double kLeastTaken = 0.75;                  // of the places that nothing hides
constexpr double kLeastOfMarks = 0.6;                 // that lie alone between them
constexpr double kMostDotMisfit = 0.04;               // of the spacing: a careful hand places dots to twice that
constexpr double kDotMisfitPx = 0.35;                 // a mark is measured no better
constexpr double kBlur = 1.8, kBlurNearStroke = 1.3;  // of a dot at half depth: so far it reaches
constexpr double kRingPx = 2.0;

cv::Point2f pointOf(const DotMark& mark) { return {static_cast<float>(mark.at.x()), static_cast<float>(mark.at.y())}; }

/// The area that the dots of a lattice cover; 0 where most of the marks in it lie beside its places: crumbs.
double coveredArea(const DotMarks& marks, const DotLattice& lattice, std::int64_t alone) {
  std::vector<cv::Point2f> places, hull;
  for (const int k : lattice.dots) places.push_back(pointOf(marks.marks[k]));
  cv::convexHull(places, hull);
  const auto within = std::ranges::count_if(marks.marks, [&](const DotMark& mark) {
    return mark.isAlone && cv::pointPolygonTest(hull, pointOf(mark), false) >= 0.0;
  });
  if (static_cast<double>(alone) < kLeastOfMarks * static_cast<double>(within)) return 0.0;
  return cv::contourArea(hull);
}

bool isPrintedGrid(const DotMarks& marks, const DotLattice& lattice) {
  const auto alone = std::ranges::count_if(lattice.dots, [&](int k) { return marks.marks[k].isAlone; });
  if (alone < kFewestDots || marks.longestOther < lattice.spacing) return false;
  if (lattice.misfit > kMostDotMisfit * lattice.spacing + kDotMisfitPx) return false;
  if (lattice.taken < kLeastTaken * (lattice.taken + lattice.bare)) return false;
  return coveredArea(marks, lattice, alone) >= kLeastOfPage * marks.width * marks.height;
}

/// An ellipse of pixels around a dot.
template <class Visit>
void visitAround(const GreyImage& page, const Vec2& at, double across, double down, const Visit& visit) {
  const int y0 = std::max(0, static_cast<int>(at.y() - down)),
            y1 = std::min(page.height - 1, static_cast<int>(at.y() + down));
  const int x0 = std::max(0, static_cast<int>(at.x() - across)),
            x1 = std::min(page.width - 1, static_cast<int>(at.x() + across));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double u = (x + 0.5 - at.x()) / across, v = (y + 0.5 - at.y()) / down;
      if (u * u + v * v <= 1.0) visit(x, y);
    }
  }
}

}  // namespace

std::vector<PrintedDot> findDotGrid(const GreyImage& image, const RunContext& context) {
  if (image.isUniform) return {};
  int shrink = 1;
  while (static_cast<std::int64_t>(image.width / shrink) * (image.height / shrink) > kLargestDottedPx) ++shrink;
  const Plane grey = shrinkGrey(image, shrink, context);
  if (context.isCancelled() || !hasMarksAllOver(grey, context)) return {};
  const DotMarks marks = findDotMarks(grey, context);
  if (context.isCancelled() || std::ssize(marks.marks) < kFewestDots) return {};
  const DotLattice lattice = largestDotLattice(marks);
  if (!isPrintedGrid(marks, lattice)) return {};
  std::vector<PrintedDot> dots;
  for (const int k : lattice.dots) {
    const DotMark& mark = marks.marks[k];
    dots.push_back({mark.at * shrink, mark.width * shrink, mark.height * shrink, mark.isAlone});
  }
  return dots;
}

GreyImage withoutDots(GreyImage page, const std::vector<PrintedDot>& dots) {
  std::vector<std::uint16_t> around;
  for (const PrintedDot& dot : dots) {
    const double blur = dot.isAlone ? kBlur : kBlurNearStroke;
    const double across = 0.5 * blur * dot.widthPx + 1.0, down = 0.5 * blur * dot.heightPx + 1.0;
    around.clear();
    visitAround(page, dot.atPx, across + kRingPx, down + kRingPx, [&](int x, int y) {
      const double u = (x + 0.5 - dot.atPx.x()) / across, v = (y + 0.5 - dot.atPx.y()) / down;
      if (u * u + v * v > 1.0) around.push_back(page.row(y)[x]);
    });
    if (around.empty()) continue;
    const std::uint16_t paper = upperMedian(around);
    visitAround(page, dot.atPx, across, down, [&](int x, int y) {
      std::uint16_t& pixel = page.row(y)[x];
      pixel = std::max(pixel, paper);
    });
  }
  return page;
}

}  // namespace batten
