// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/page_scale.h"

#include "core/image/fine_page.h"

namespace batten {
namespace {

StrokePath pathOnPage(const StrokePath& fine) {
  StrokePath path;
  path.closed = fine.closed;
  path.tip = fine.tip;
  const int n = static_cast<int>(fine.points.size());
  const auto take = [&](int i) {
    const StrokePathPoint& p = fine.points[i];
    path.points.push_back({p.at / kFineFactor, p.radius / kFineFactor, p.part});
  };
  int i = 0;
  for (; i < n; i += kFineFactor) take(i);
  if (!fine.closed && n > 0 && i - kFineFactor != n - 1) take(n - 1);
  return path;
}

}  // namespace

void scaleContour(Contour& c, double factor) {
  const auto by = static_cast<float>(factor);
  for (ContourPoint& p : c.points) {
    p.at *= factor;
    p.unrefined *= factor;
    if (p.sigmaPx) *p.sigmaPx *= by;
    if (p.widthPx) *p.widthPx *= by;
    if (p.bundle) p.bundle = BundleWidths{p.bundle->left * by, p.bundle->right * by};
  }
  if (c.blurPx) *c.blurPx *= factor;
  if (c.pencilPx) *c.pencilPx *= factor;
  if (c.traceMode) c.traceMode->positionPx *= factor;
  c.lengthPx *= factor;
  c.areaPx *= factor * factor;
}

void scaleContours(ContourSet& set, double factor) {
  for (Contour& c : set.contours) scaleContour(c, factor);
  for (Contour& c : set.sheetEdges) scaleContour(c, factor);
  for (StrokeJunction& junction : set.junctions) {
    junction.positionPx *= factor;
    junction.radiusPx *= factor;
    for (Vec2& place : junction.branchesPx) place *= factor;
  }
  if (set.report.widthPx) *set.report.widthPx *= factor;
}

std::vector<StrokePath> fromFinePage(const std::vector<StrokePath>& paths) {
  std::vector<StrokePath> reduced;
  reduced.reserve(paths.size());
  for (const StrokePath& path : paths) reduced.push_back(pathOnPage(path));
  return reduced;
}

}  // namespace batten
