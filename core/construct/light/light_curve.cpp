// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_curve.h"

#include <iterator>
#include <utility>

#include "core/construct/light/light_chain.h"
#include "core/construct/light/light_search.h"
#include "core/curve/curve_start.h"

namespace batten {
namespace {

constexpr int kMostInOneSpline = 8;  // extrema: a curve of more is cut into sections at once
/// Sections of a curve: a hand draws far fewer in one line, and each takes 10 to 40 ms.
constexpr std::ptrdiff_t kMostSections = 300;

LightCurve sameCurve(const NurbsCurve& dense, LightObstacle obstacle) {
  LightCurve same{dense, {}};
  same.report.points = same.report.pointsBefore = dense.controlPointCount();
  same.report.obstacle = obstacle;
  return same;
}

/// No fewer have sections that meet with one curvature: each has 6, and at a joint two are spared.
int fewestOfSections(int sections, bool closed) { return 4 * sections + (closed ? 1 : 2); }

/// Of a closed curve, begun between two extrema.
std::optional<LightCurve> chainAround(const NurbsCurve& dense, const LightReference& reference,
                                      const LightOptions& options, const RunContext& context) {
  const auto begun = startedAt(dense, reference.at(0).u);
  if (!begun) return std::nullopt;
  const auto again = LightReference::make(*begun, true, options.step, {}, context);
  if (!again) return std::nullopt;
  return lightChain(*begun, *again, lightSections(*begun, *again, options), options, context);
}

LightCurve lightest(const NurbsCurve& dense, bool closed, const LightOptions& options, const RunContext& context) {
  const auto reference = LightReference::make(dense, closed, options.step, {}, context);
  if (!reference) return sameCurve(dense, LightObstacle::NoNormal);
  const LightSections sections = lightSections(dense, *reference, options);
  if (std::ssize(sections.cuts) >= kMostSections) return sameCurve(dense, LightObstacle::Effort);
  LightCurve found;
  const bool mayBeCut = !sections.cuts.empty() &&
                        fewestOfSections(static_cast<int>(sections.cuts.size()) + 1, closed) <= options.mostPoints;
  if (sections.extrema <= kMostInOneSpline) {
    LightTask whole;
    if (std::ssize(dense.breaks()) > kMostSectionSpans + 1) whole.mostPoints = 0;  // a line or an arc, or in sections
    found = searchLight(dense, *reference, options, whole, context);
    if (found.report.kind != LightKind::Dense || context.isCancelled()) return found;
  } else {
    found = sameCurve(dense, LightObstacle::Effort);
  }
  if (sections.cuts.empty()) return found;
  if (!mayBeCut) return tooManyPoints(dense);
  auto chain = closed ? chainAround(dense, *reference, options, context)
                      : lightChain(dense, *reference, sections, options, context);
  return chain ? std::move(*chain) : std::move(found);
}

}  // namespace

LightCurve tooManyPoints(const NurbsCurve& dense) { return sameCurve(dense, LightObstacle::Points); }

Result<LightCurve> makeLight(const NurbsCurve& dense, bool closed, const LightOptions& options,
                             const RunContext& context) {
  if (!(options.tolerance > 0.0) || !(options.step > 0.0) || !(options.significance >= 0.0)) {
    return fail(ErrorCode::BadParameter, "The tolerance of a light curve must be above 0.");
  }
  LightCurve found = lightest(dense, closed, options, context);
  if (context.isCancelled()) return cancelled();
  return found;
}

}  // namespace batten
