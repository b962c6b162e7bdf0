// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/session/editor_session.h"

namespace batten {

/// Whether a target's curve can be advised, said alike wherever the six targets are shown. `degree` is 1 to 6.
/// The target is met, and its curve stays within the budget.
bool isWithinBudget(const TargetOutcomes&, int degree, double budgetMm);
/// Within the budget, with fewer bumps than before; or with as many, and it moves the curve at all.
bool isAdvisable(const TargetOutcomes&, int degree, double budgetMm);

}  // namespace batten
