// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/targets/target_advice.h"

namespace batten {
namespace {

/// Of the budget: a curve that moves less than this has not been faired.
constexpr double kStill = 1e-3;
/// A profile less like the sketch than this says nothing about it. Of a line with waves that go, S may be 0.4.
constexpr double kLeastSimilarity = 0.2;

}  // namespace

bool isWithinBudget(const TargetOutcomes& outcomes, int degree, double budgetMm) {
  const auto& faired = outcomes.faired[degree - 1];
  return faired && faired->report.withinBudget && faired->report.maxDeviationMm <= budgetMm * (1 + 1e-9);
}

bool isAdvisable(const TargetOutcomes& outcomes, int degree, double budgetMm) {
  if (!isWithinBudget(outcomes, degree, budgetMm)) return false;
  const auto at = static_cast<std::size_t>(degree - 1);
  const FairingReport& report = outcomes.faired[at]->report;
  return report.maxDeviationMm > kStill * budgetMm && report.extremaAfter <= report.extremaBefore &&
         outcomes.targets.profiles[at].similarity >= kLeastSimilarity;
}

}  // namespace batten
