// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/explain/explanation.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/contour/region_of_interest.h"
#include "core/document/explain/redraw.h"
#include "core/image/binarize.h"
#include "core/image/bit_disc.h"
#include "core/image/bit_steps.h"

namespace batten {
namespace {

constexpr double kReferenceStrength = 0.6;  // of the contrast that is asked of ink by default
constexpr double kPixelPx = 0.5;            // ink begins half a pixel before the centre of its first pixel
constexpr double kLeastExplained = 0.92, kMostInvented = 0.005;

Result<BitImage> referenceInk(const GreyImage& page, const Recipe& recipe, const RunContext& context) {
  ThresholdParams asked;
  asked.strength = kReferenceStrength;
  const auto thresholds = findThresholds(page, {}, asked, context);
  if (!thresholds) return fail(thresholds.error());
  auto ink = binarize(page, *thresholds, asked, context);
  if (!ink || recipe.regions.empty()) return ink;
  for (int y = 0; y < ink->height && !context.isCancelled(); ++y) {
    for (int x = 0; x < ink->width; ++x) {
      if (ink->at(x, y) && !isInside(recipe.regions, {x + 0.5, y + 0.5})) ink->set(x, y, false);
    }
  }
  return ink;
}

// Adds what of a curve lies on paper.
void findInventions(const RedrawnCurve& c, const BitImage& ink, Explanation& result, double& inventedPx) {
  std::optional<InventedStretch> open;
  for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
    const RedrawnPoint& p = c.points[i];
    const double step = (c.points[i + 1].at - p.at).norm();
    result.curvesPx += step;
    const bool isInvented = !p.isBridge && !anyInDisc(ink, p.at, explainingReach(p) + kPixelPx);
    if (!isInvented) {
      if (open) result.inventions.push_back(*open);
      open.reset();
      continue;
    }
    if (!open) open = InventedStretch{c.curve, p.at, p.at, 0.0};
    open->toPx = c.points[i + 1].at;
    open->lengthPx += step;
    inventedPx += step;
  }
  if (open) result.inventions.push_back(*open);
}

std::string percent(double share) {
  const long tenths = std::lround(1000.0 * share);
  return std::to_string(tenths / 10) + '.' + std::to_string(tenths % 10) + " %";
}

std::string noteOn(const Explanation& e) {
  std::string note;
  if (e.referencePx > 0 && e.explained < kLeastExplained) {
    note = "The curves explain " + percent(e.explained) +
           " of the ink on the page: lower the thresholds' strength or the shortest line to see more of it.";
  }
  if (e.invented > kMostInvented) {
    if (!note.empty()) note += ' ';
    note += percent(e.invented) + " of the length of the curves has no ink under it.";
  }
  return note;
}

Result<Explanation> explain(const Scan& scan, const Recipe& recipe, const PipelineOutput& out,
                            const RunContext& context) {
  Explanation result;
  auto ink = referenceInk(tracedGrey(scan, out), recipe, context);
  if (!ink) return fail(ink.error());
  const std::vector<RedrawnCurve> curves = redrawCurves(out, context);
  result.referencePx = ink->count();
  result.missedInk = without(*ink, redrawPage(curves, out, *ink, context));
  if (result.referencePx > 0) {
    result.missed = static_cast<double>(result.missedInk.count()) / static_cast<double>(result.referencePx);
    result.explained = 1.0 - result.missed;
  }
  double inventedPx = 0.0;
  for (const RedrawnCurve& c : curves) {
    if (context.isCancelled()) return cancelled();
    if (c.kind != ContourKind::Pen) findInventions(c, *ink, result, inventedPx);
  }
  if (result.curvesPx > 0.0) result.invented = inventedPx / result.curvesPx;
  std::stable_sort(result.inventions.begin(), result.inventions.end(),
                   [](const InventedStretch& a, const InventedStretch& b) { return a.lengthPx > b.lengthPx; });
  if (result.inventions.size() > kMostInventions) result.inventions.resize(kMostInventions);
  result.note = noteOn(result);
  if (context.isCancelled()) return cancelled();
  return result;
}

}  // namespace

Result<Explanation> explainPage(const Scan& scan, const Recipe& recipe, const PipelineOutput& out,
                                const RunContext& context) {
  try {
    return explain(scan, recipe, out, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to compare the curves with the ink.");
  }
}

}  // namespace batten
