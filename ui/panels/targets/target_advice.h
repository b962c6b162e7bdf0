// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/fairing/fairing.h"
#include "ui/session/editor_session.h"

namespace batten {

/// Whether a target's curve can be advised, said alike wherever the six targets are shown. `degree` is 1 to 6.
/// The target is met, and its curve stays within the tolerance.
bool isWithinTolerance(const TargetOutcomes&, int degree, double toleranceMm);
/// Within the tolerance, without more bumps than before; it moves the curve at all, and its profile is like the
/// sketch's (similarity S of 0.2 and more).
bool isAdvisable(const TargetOutcomes&, int degree, double toleranceMm);

}  // namespace batten
