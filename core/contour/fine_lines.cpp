// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/fine_lines.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/contour/centreline/page_scale.h"
#include "core/image/fine_page.h"

namespace batten {
namespace {

// Centre lines have a point a pixel of the page already. Of a few points none may be spared.
void thinOut(Contour& outline) {
  constexpr int kFewestPoints = 8;  // half as many still make a shape
  if (std::ssize(outline.points) < kFewestPoints) return;
  std::vector<ContourPoint> kept;
  for (std::size_t i = 0; i < outline.points.size(); i += kFineFactor) kept.push_back(outline.points[i]);
  const int last = static_cast<int>(kept.size()) - 1;
  for (auto& [from, to] : outline.bridges) {
    from = (from + kFineFactor - 1) / kFineFactor;
    to = std::min(to / kFineFactor, last);
  }
  // One between two kept points is none any more.
  std::erase_if(outline.bridges, [](const auto& bridge) { return bridge.first > bridge.second; });
  outline.points = std::move(kept);
  measureContour(outline);
}

}  // namespace

EdgeParams onFinePage(EdgeParams edges) {
  for (EdgeChoice& choice : edges.choices) {
    choice.positionPx *= kFineFactor;
    choice.reachPx *= kFineFactor;
  }
  for (PaintedInk& painted : edges.painted) {
    painted.radiusPx = scaledRadius(painted, kFineFactor);
    for (Vec2& place : painted.coursePx) place *= kFineFactor;
  }
  for (JunctionChoice& choice : edges.junctions) {
    choice.positionPx *= kFineFactor;
    choice.reachPx *= kFineFactor;
    for (BranchPair& pair : choice.pairs) {
      pair.firstPx *= kFineFactor;
      pair.secondPx *= kFineFactor;
    }
  }
  return edges;
}

ContourParams onFinePage(ContourParams params) {
  params.minLengthPx *= kFineFactor;
  return params;
}

ContourSet fromFinePage(ContourSet set) {
  for (Contour& c : set.contours) {
    if (c.kind == ContourKind::Outline) thinOut(c);
  }
  scaleContours(set, 1.0 / kFineFactor);
  return set;
}

}  // namespace batten
