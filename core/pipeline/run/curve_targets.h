// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// The six targets of one curve, as the strip and the report show them.
/// @param spanAt share of the arc length: of the natural span there alone, the rest held.
Result<TargetOutcomes> targetsFor(const TracedCurve&, const RunContext&, std::optional<double> spanAt = {});

/// The same for many curves at once, those left out excepted (their entry is Cancelled): one entry a curve.
std::vector<Result<TargetOutcomes>> targetsForAll(std::span<const TracedCurve>, const RunContext&);

}  // namespace batten
