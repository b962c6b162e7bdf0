// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/untraced_ink.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/contour/ink/line_choices.h"
#include "core/contour/outline/ink_borders.h"
#include "core/image/threshold/binarize.h"

namespace batten {
namespace {

// Where lines cross that are wider than the paper between them no stroke has a middle of its own: the borders of the
// net are followed instead. Ink with fewer holes is none.
Result<ContourSet> bordersOfNets(const BitImage& ink, const ContourParams& params, const RunContext& context) {
  constexpr int kFewestHoles = 9;  // of a net: three lines across three are the least that could be a grid
  ContourParams meshes = params;
  // The borders of a mesh are short where the lines are wide.
  if (!hasOwnLengths(params)) meshes.minWidths = 0.0;
  Result<ContourSet> set = bordersOf(ink, true, meshes, std::nullopt, nullptr, context);
  if (!set) return set;
  const auto holes = std::count_if(set->contours.begin(), set->contours.end(), [](const Contour& c) { return c.hole; });
  if (holes < kFewestHoles) {
    set->contours.clear();
  } else {
    addNote(*set, "The lines are too close together to be told apart; the borders of their ink were traced.");
  }
  return set;
}

// The ink that the lines stand for, by their lengths and widths and by the areas within outlines, of all ink.
double explainedInk(const ContourSet& set, const BitImage& ink) {
  double area = 0.0;
  for (const Contour& c : set.contours) {
    if (c.kind == ContourKind::Outline) {
      area += (c.hole ? -1.0 : 1.0) * std::fabs(c.areaPx);
      continue;
    }
    double width = 0.0;
    for (const float w : strokeWidthsOf(c.points))
      width += static_cast<double>(w) / static_cast<double>(std::ssize(c.points));
    area += c.lengthPx * width;
  }
  return area / std::max(1.0, static_cast<double>(ink.count()));
}

constexpr double kLeastExplained = 0.5;  // of the ink

// Whether lines may have gone lost in a net: none came, they stand for too little of the ink, or the meshes of an
// outline were dropped as short.
bool mayHaveLostANet(const ContourSet& set, const BitImage& ink, const EdgeParams& edges, const ContourParams& params) {
  if (set.contours.empty()) return true;
  if (!isOfAllInk(edges, params)) return false;
  return explainedInk(set, ink) < kLeastExplained ||
         set.report.droppedHolesPx > kMeshShare * static_cast<double>(ink.count());
}

// Whether the borders of a net show what the lines do not: a net has many more meshes than lines, torn strokes and
// strokes that were dropped as short have not.
bool isMoreOfIt(const ContourSet& net, const ContourSet& lines) {
  constexpr std::ptrdiff_t kMeshesPerLine = 10;  // n lines across n have n / 2 to each; few of them came
  return std::ssize(net.contours) > kMeshesPerLine * std::ssize(lines.contours);
}

}  // namespace

bool isOfAllInk(const EdgeParams& edges, const ContourParams& params) {
  const bool isChosen = !edges.choices.empty() || !edges.painted.empty();
  return edges.mode == EdgeMode::Automatic && edges.mergeWidths <= 0.0 && !edges.intent && !isChosen &&
         !hasOwnLengths(params);
}

Result<std::optional<ContourSet>> bordersOfLostNet(const ContourSet& lines, const BitImage& ink,
                                                   const EdgeParams& edges, const ContourParams& params,
                                                   const RunContext& context) {
  if (!mayHaveLostANet(lines, ink, edges, params)) return std::nullopt;
  Result<ContourSet> net = bordersOfNets(ink, params, context);
  if (!net) return fail(net.error());
  if (!isMoreOfIt(*net, lines)) return std::nullopt;
  return std::move(*net);
}

void noteUntraced(ContourSet& set, const BitImage& ink) {
  const double share = explainedInk(set, ink);
  if (set.contours.empty() || set.report.droppedMargins > 0 || share >= kLeastExplained) return;
  addNote(set, "Only " + std::to_string(std::lround(100.0 * std::max(0.0, share))) + " % of the ink is traced: " +
                   (set.report.droppedShort > 0 ? "contours.min_widths=0 keeps short lines, and " : "") +
                   "edges.mode=outline traces the borders of all ink.");
}

}  // namespace batten
