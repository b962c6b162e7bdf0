// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/targets/target_advice.h"

#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"

namespace batten {
namespace {

/// Of the tolerance: a curve that moves less than this has not been faired.
constexpr double kStill = 1e-3;
/// A profile less like the sketch than this says nothing about it. Of a line with waves that go, S may be 0.4.
constexpr double kLeastSimilarity = 0.2;

}  // namespace

bool isWithinTolerance(const TargetOutcomes& outcomes, int degree, double toleranceMm) {
  const auto& faired = outcomes.faired[degree - 1];
  return faired && faired->report.withinTolerance && faired->report.maxDeviationMm <= toleranceMm * (1 + 1e-9);
}

bool isAdvisable(const TargetOutcomes& outcomes, int degree, double toleranceMm) {
  if (!isWithinTolerance(outcomes, degree, toleranceMm)) return false;
  const auto at = static_cast<std::size_t>(degree - 1);
  const FairingReport& report = outcomes.faired[at]->report;
  return report.maxDeviationMm > kStill * toleranceMm && report.extremaAfter <= report.extremaBefore &&
         outcomes.targets.profiles[at].similarity >= kLeastSimilarity;
}

}  // namespace batten
