// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/target_advice.h"

namespace batten {
namespace {

/// Of the budget: a curve that moves less than this has not been faired.
constexpr double kStill = 1e-3;

}  // namespace

bool isWithinBudget(const TargetOutcomes& outcomes, int degree, double budgetMm) {
  const auto& faired = outcomes.faired[static_cast<std::size_t>(degree - 1)];
  return faired && faired->report.withinBudget && faired->report.maxDeviationMm <= budgetMm * (1 + 1e-9);
}

bool isAdvisable(const TargetOutcomes& outcomes, int degree, double budgetMm) {
  if (!isWithinBudget(outcomes, degree, budgetMm)) return false;
  const FairingReport& report = outcomes.faired[static_cast<std::size_t>(degree - 1)]->report;
  const bool moves = report.maxDeviationMm > kStill * budgetMm;
  return report.extremaAfter < report.extremaBefore || (report.extremaAfter == report.extremaBefore && moves);
}

}  // namespace batten
