// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_corners.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/curve/corners_inside.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

constexpr double kPartsMeet = 1e-6;  // of the extent

/// A rational part, which no other can be joined with, stays as it was.
NurbsCurve lightPart(const NurbsCurve& part, const LightOptions& options, const RunContext& context) {
  auto light = makeLight(part, false, options, context);
  if (!light || light->report.kind == LightKind::Dense || light->curve.isRational()) return part;
  return std::move(light->curve);
}

}  // namespace

std::optional<NurbsCurve> joinedAtCorners(const std::vector<NurbsCurve>& parts, double tolerance) {
  int degree = 1;
  for (const NurbsCurve& part : parts) degree = std::max(degree, part.degree());
  std::vector<NurbsCurve> curves;
  for (const NurbsCurve& part : parts) {
    auto raised = part.degree() < degree ? elevated(part, degree) : Result<NurbsCurve>(part);
    if (!raised) return std::nullopt;
    curves.push_back(std::move(*raised));
  }
  if (curves.size() == 1) return curves.front();
  auto joined = joinAtCorners(curves, tolerance);
  return joined ? std::optional(std::move(*joined)) : std::nullopt;
}

std::optional<NurbsCurve> lightBetweenCorners(const NurbsCurve& dense, bool closed, const LightOptions& options,
                                              const RunContext& context) {
  const std::vector<double> corners = cornersInside(dense);
  if (corners.empty() || (closed && !beginsAtCorner(dense))) {
    auto light = makeLight(dense, closed, options, context);
    if (!light || light->report.kind == LightKind::Dense) return std::nullopt;
    return std::move(light->curve);
  }
  auto parts = splitAtAll(dense, corners);
  if (!parts) return std::nullopt;
  for (std::size_t i = 0; i <= corners.size(); ++i) {
    LightOptions own = options;
    if (i > 0 || closed) own.start = LightHold::Position;
    if (i < corners.size() || closed) own.end = LightHold::Position;
    (*parts)[i] = lightPart((*parts)[i], own, context);
  }
  if (context.isCancelled()) return std::nullopt;
  auto joined = joinedAtCorners(*parts, kPartsMeet * extent(dense));
  if (!joined || joined->controlPointCount() >= dense.controlPointCount()) return std::nullopt;
  return joined;
}

}  // namespace batten
