// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/explain/explanation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

#include "core/contour/centreline/profile/stroke_profile.h"
#include "core/contour/region_of_interest.h"
#include "core/document/explain/redraw.h"
#include "core/image/bits/bit_disc.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/page_margins.h"
#include "core/image/threshold/binarize.h"
#include "core/image/threshold/region_surface.h"

namespace batten {
namespace {

constexpr double kReferenceStrength = 0.6;  // of the contrast that is asked of ink by default
constexpr double kPixelPx = 0.5;            // ink begins half a pixel before the centre of its first pixel

// What curves are held against.
struct Reference {
  const GreyImage& page;
  BitImage ink;
  RegionThresholds thresholds;
};

// Ink at the contrast asked by default, and at a lower one: a faint line can be told from texture at the first where it
// runs together with other faint ink at the second.
Result<Reference> makeReference(const GreyImage& page, const Recipe& recipe, const RunContext& context) {
  ThresholdParams asked;
  auto thresholds = findThresholds(page, {}, asked, context);
  if (!thresholds) return fail(thresholds.error());
  const auto clear = binarizePage(page, *thresholds, asked, context);
  if (!clear) return fail(clear.error());
  // The same part of the half level on every page.
  asked.strength = kReferenceStrength / thresholds->halfLevelShare;
  thresholds = findThresholds(page, {}, asked, context);
  if (!thresholds) return fail(thresholds.error());
  auto ink = binarize(page, *thresholds, asked, context);
  if (!ink) return fail(ink.error());
  *ink = either(std::move(*ink), *clear);
  for (int y = 0; y < ink->height && !recipe.regions.empty() && !context.isCancelled(); ++y) {
    for (int x = 0; x < ink->width; ++x) {
      if (ink->at(x, y) && !isInside(recipe.regions, {x + 0.5, y + 0.5})) ink->set(x, y, false);
    }
  }
  return Reference{page, std::move(*ink), std::move(*thresholds)};
}

// The edge of a sheet in the picture is not drawn.
BitImage withoutSheetEdges(BitImage ink, const std::vector<Contour>& edges) {
  if (edges.empty()) return ink;
  BitImage along(ink.width, ink.height);
  for (const Contour& edge : edges) {
    for (const ContourPoint& p : edge.points)
      setExplained(along, {p.at, 0.5 * static_cast<double>(p.widthPx.value_or(0.0f)), false});
  }
  return without(ink, along);
}

// [grey] By which the page is darker at a place of a line than at both its sides, where that is the least; of a border,
// by which it is darker on the right.
double depthAt(const RedrawnPoint& p, const Vec2& along, bool isBorder, const GreyImage& page) {
  constexpr double kBesidePx[] = {1.5, 2.5, 3.5};  // to either side
  const Vec2 across = leftNormal(along.normalized());
  const auto level = [&](double off) {
    double sum = 0.0;
    for (const int step : {-1, 0, 1}) {
      const Vec2 at = p.at + off * across + step * along.normalized();
      sum += static_cast<double>(sampleGrey(page, at.x(), at.y())) / 3.0;
    }
    return sum;
  };
  double left = 0.0, right = 0.0;
  for (const double beside : kBesidePx) {
    left += level(p.halfWidthPx + beside) / std::ssize(kBesidePx);
    right += level(-p.halfWidthPx - beside) / std::ssize(kBesidePx);
  }
  return isBorder ? left - right : std::min(left, right) - level(0.0);
}

// A line or border may be too faint for the reference at every pixel and still be seen along its length: the mean over
// a stretch is known better than a pixel by the root of their number.
bool isFaintlySeen(const RedrawnCurve& c, std::size_t first, std::size_t last, const Reference& reference) {
  constexpr std::size_t kFewestPoints = 6;  // of a stretch
  constexpr double kClear = 3.0;            // [standard deviations of the mean]
  constexpr double kNoiseLengthPx = 3.0;    // along which the noise of the smoothed page is alike
  constexpr double kFaintShare = 0.25;      // of the minimum contrast of reference ink
  if (last - first < kFewestPoints) return false;
  double depth = 0.0, contrast = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const Vec2& at = c.points[i].at;
    const Vec2 along = c.points[i + 1].at - at;
    if (!(along.norm() > 0.0)) return false;
    depth += depthAt(c.points[i], along, c.kind == ContourKind::Outline, reference.page);
    const int region = regionOf(std::clamp(static_cast<int>(at.x()), 0, reference.page.width - 1),
                                std::clamp(static_cast<int>(at.y()), 0, reference.page.height - 1),
                                reference.page.width, reference.page.height);
    contrast -= reference.thresholds.contrast[region];
  }
  if (c.kind == ContourKind::Outline) depth = std::abs(depth);
  const auto count = static_cast<double>(last - first);
  const double sigma = reference.thresholds.paperNoise * std::sqrt(kNoiseLengthPx / count);
  return depth / count > std::max(kClear * sigma, kFaintShare * contrast / count);
}

// How much of a curve lies on paper.
struct CurveOnPage {
  double lengthPx = 0.0;
  double inventedPx = 0.0;
  std::vector<InventedStretch> inventions;
};

CurveOnPage findInventions(const RedrawnCurve& c, const Reference& reference) {
  CurveOnPage found;
  std::optional<std::size_t> first;
  double lengthPx = 0.0;
  const auto close = [&](std::size_t last) {
    if (first && !isFaintlySeen(c, *first, last, reference)) {
      InventedStretch& stretch = found.inventions.emplace_back();
      stretch = {c.curve, lengthPx, {}};
      for (std::size_t i = *first; i <= last; ++i) stretch.linePx.push_back(c.points[i].at);
      found.inventedPx += lengthPx;
    }
    first.reset();
    lengthPx = 0.0;
  };
  for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
    const RedrawnPoint& p = c.points[i];
    const double step = (c.points[i + 1].at - p.at).norm();
    found.lengthPx += step;
    if (p.isBridge || anyInDisc(reference.ink, p.at, explainingReach(p) + kPixelPx)) {
      close(i);
      continue;
    }
    if (!first) first = i;
    lengthPx += step;
  }
  if (!c.points.empty()) close(c.points.size() - 1);
  return found;
}

// What is asked of the page, by what most of its strokes were drawn with. A pencil's points have no noise of their own
// that could be told from its grain; nor have points that were not refined.
double leastExplainedOf(const PipelineOutput& out, const EdgeParams& edges) {
  if (!out.contours || !edges.subpixel || edges.intent) return kLeastExplainedPen;
  double pen = 0.0, pencil = 0.0;
  for (const Contour& line : out.contours->contours) {
    if (line.kind != ContourKind::Centreline) continue;
    for (const ContourPoint& p : line.points) (p.sigmaPx ? pen : pencil) += 1.0;
  }
  return pencil > pen ? kLeastExplainedPencil : kLeastExplainedPen;
}

std::string tenthsText(double tenths) {
  const auto whole = static_cast<long>(tenths);
  return std::to_string(whole / 10) + '.' + std::to_string(whole % 10) + " %";
}

// Rounded towards the worse: what is beyond a limit must not read as the limit itself.
constexpr double kExactTenths = 1e-6;  // of the limits, as numbers with a rounding error
std::string percentAtLeast(double share) { return tenthsText(std::floor(1000.0 * share + kExactTenths)); }
std::string percentAtMost(double share) { return tenthsText(std::ceil(1000.0 * share - kExactTenths)); }

std::string noteOn(const Explanation& e, const EdgeParams& edges) {
  std::string note;
  if (edges.intent && (!e.isExplained() || e.isInvented())) {
    // One curve stands for several strokes: it leaves ink beside it and runs over paper between them, as it should.
    return "The curves explain " + percentAtLeast(e.explained) + " of the ink on the page, and " +
           percentAtMost(e.invented) +
           " of their length has no ink under it: with edges.intent one curve stands for several strokes, which need "
           "not lie under it. To measure how completely the strokes are traced, set edges.intent=false.";
  }
  if (!e.isExplained()) {
    note = "The curves explain " + percentAtLeast(e.explained) + " of the ink on the page, less than " +
           percentAtLeast(e.leastExplained) +
           ". To trace more, lower threshold.strength (Minimum ink contrast) or the minimum line length.";
  }
  if (e.isInvented()) {
    if (!note.empty()) note += ' ';
    note += percentAtMost(e.invented) + " of the length of the curves has no ink under it, more than " +
            percentAtMost(kMostInvented) + ".";
  }
  return note;
}

Result<Explanation> explain(const Scan& scan, const Recipe& recipe, const PipelineOutput& out,
                            const RunContext& context) {
  Explanation result;
  const auto reference = makeReference(tracedGrey(scan, out), recipe, context);
  if (!reference) return fail(reference.error());
  BitImage drawn = withoutMargins(reference->ink, context);
  if (out.contours) drawn = withoutSheetEdges(std::move(drawn), out.contours->sheetEdges);
  const std::vector<RedrawnCurve> curves = redrawCurves(out, context);
  result.referencePx = drawn.count();
  result.missedInk = without(drawn, redrawPage(curves, out, drawn, context));
  if (result.referencePx > 0) {
    result.missed = static_cast<double>(result.missedInk.count()) / static_cast<double>(result.referencePx);
    result.explained = 1.0 - result.missed;
  }
  double inventedPx = 0.0;
  for (const RedrawnCurve& c : curves) {
    if (context.isCancelled()) return cancelled();
    if (c.kind == ContourKind::Pen) continue;
    const CurveOnPage found = findInventions(c, *reference);
    result.curvesPx += found.lengthPx;
    inventedPx += found.inventedPx;
    result.inventions.insert(result.inventions.end(), found.inventions.begin(), found.inventions.end());
  }
  if (result.curvesPx > 0.0) result.invented = inventedPx / result.curvesPx;
  std::stable_sort(result.inventions.begin(), result.inventions.end(),
                   [](const InventedStretch& a, const InventedStretch& b) { return a.lengthPx > b.lengthPx; });
  result.leastExplained = leastExplainedOf(out, recipe.edges);
  result.note = noteOn(result, recipe.edges);
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
