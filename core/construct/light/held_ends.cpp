// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/held_ends.h"

#include <cmath>

#include "core/curve/curvature.h"
#include "core/curve/held_end.h"

namespace batten {
namespace {

constexpr double kHeldAngle = 1e-4;      // [rad]
constexpr double kHeldCurvature = 0.01;  // of the largest

const LightSample& endOf(const LightReference& reference, bool atEnd) {
  return atEnd ? reference.samples().back() : reference.samples().front();
}

std::optional<NurbsCurve> held(const NurbsCurve& curve, const LightSample& wanted, LightHold hold, bool atEnd) {
  if (hold == LightHold::Position) return curve;
  const bool bends = hold == LightHold::Curvature;
  return withEnd(curve, atEnd, wanted.tangent, bends ? std::optional(wanted.kappa) : std::nullopt);
}

}  // namespace

std::optional<NurbsCurve> withHeldEnds(const NurbsCurve& curve, const LightReference& reference, LightHold start,
                                       LightHold end) {
  const auto first = held(curve, endOf(reference, false), start, false);
  return first ? held(*first, endOf(reference, true), end, true) : std::nullopt;
}

bool endsAreHeld(const NurbsCurve& curve, const LightReference& reference, LightHold start, LightHold end) {
  for (const bool atEnd : {false, true}) {
    const LightHold hold = atEnd ? end : start;
    if (hold == LightHold::Position) continue;
    const LightSample& wanted = endOf(reference, atEnd);
    const double u = atEnd ? curve.end() : curve.start();
    const Vec2 tangent = curve.derivatives(u, 1)[1].normalized();
    if (!(std::abs(cross(wanted.tangent, tangent)) <= kHeldAngle) || tangent.dot(wanted.tangent) < 0.0) return false;
    if (hold == LightHold::Tangent) continue;
    const double kappa = curvature(curve, u).value_or(0.0);
    if (!(std::abs(kappa - wanted.kappa) <= kHeldCurvature * reference.largestKappa())) return false;
  }
  return true;
}

}  // namespace batten
