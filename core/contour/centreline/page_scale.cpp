// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/page_scale.h"

namespace batten {

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
  if (c.traceMode) c.traceMode->positionPx *= factor;
  c.lengthPx *= factor;
  c.areaPx *= factor * factor;
}

void scaleContours(ContourSet& set, double factor) {
  for (Contour& c : set.contours) scaleContour(c, factor);
  for (StrokeJunction& junction : set.junctions) {
    junction.positionPx *= factor;
    junction.radiusPx *= factor;
    for (Vec2& place : junction.branchesPx) place *= factor;
  }
  if (set.report.widthPx) *set.report.widthPx *= factor;
}

}  // namespace batten
