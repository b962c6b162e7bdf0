// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"

namespace batten {

/// The degree to recommend: with TargetChoice::Similarity that of the highest S of the modified curve (003 section 6).
/// Else, of the degrees whose target is met without a curvature extremum more, the one whose curve has the fewest;
/// where none is met, of `nearest` and of those that the tolerance would allow, which for a smaller tolerance may have
/// been met. Of equal ones the lowest; none where there is no curve, or none with an S.
std::optional<int> degreeToRecommend(const FairedByDegree&, std::optional<int> nearest, const FairingParams&);

}  // namespace batten
