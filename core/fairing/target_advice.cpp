// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target_advice.h"

#include <algorithm>

#include "core/curve/curvature.h"
#include "core/fairing/fairing_params.h"

namespace batten {
namespace {

/// Of the tolerance: a curve that moves less than this has not been faired.
constexpr double kStillTarget = 1e-3;
/// A profile less like the sketch than this says nothing about it. Of a line with waves that go, S may be 0.4.
constexpr double kLeastSimilarity = 0.2;
/// Of the extent: a car's roof of 250 mm may move by 5 mm.
constexpr double kSensibleShare = 0.02;

}  // namespace

bool isWithinTolerance(const TargetOutcomes& outcomes, int degree, double toleranceMm) {
  const auto& faired = outcomes.faired[degree - 1];
  return faired && faired->report.withinTolerance && faired->report.maxDeviationMm <= toleranceMm * (1 + 1e-9);
}

bool addsExtrema(const TargetOutcomes& outcomes, int degree) {
  const auto& faired = outcomes.faired[degree - 1];
  return faired && faired->report.extremaAfter > faired->report.extremaBefore;
}

std::optional<int> advisedDegree(const TargetOutcomes& outcomes, double toleranceMm) {
  const std::optional<int> degree = outcomes.recommendedDegree;
  return degree && isAdvisable(outcomes, *degree, toleranceMm) ? degree : std::nullopt;
}

double mostSensibleToleranceMm(const NurbsCurve& curve) {
  return curve.isEmpty() ? 0.0 : std::min(kLargestToleranceMm, kSensibleShare * extent(curve));
}

bool isAdvisable(const TargetOutcomes& outcomes, int degree, double toleranceMm) {
  if (!isWithinTolerance(outcomes, degree, toleranceMm)) return false;
  const int at = degree - 1;
  const FairingReport& report = outcomes.faired[at]->report;
  return report.maxDeviationMm > kStillTarget * toleranceMm && !addsExtrema(outcomes, degree) &&
         outcomes.targets.profiles[at].similarity >= kLeastSimilarity;
}

}  // namespace batten
