// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/pipeline/run/pipeline.h"

namespace batten {

/// True when fairing (or the rounding of a corner) gave the curve another shape than the sketched one.
bool isChanged(const TracedCurve& curve);
/// Fairing was asked for and moved the curve by less than a thousandth of the tolerance.
bool isLeftAsDrawn(const TracedCurve& curve);
/// Why fairing left a curve as it was drawn, one sentence; empty where it did not.
std::string leftAsDrawnReason(const TracedCurve& curve);

}  // namespace batten
