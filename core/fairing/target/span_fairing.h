// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// The six polynomials of one span of a curve: each takes the curve's own curvature where the span meets the rest, and
/// is eased into it over a fifth of the span.
/// Outside of the span the profile is the curve's own curvature. Similarities are of the span alone.
TargetSet fitSpanTargets(const NurbsCurve&, bool closed, const TargetParams&, const ProfileSpan&);

/// A setup in which only the span moves. It gets knots of its own, until there are enough of them; the rest of the
/// curve stays as it is to the last digit, and meets the span with all derivatives but the highest.
/// @return Numerical where nothing of the span could move.
Result<std::shared_ptr<const FairingSetup>> makeSpanSetup(const NurbsCurve&, bool closed, const FairingParams&,
                                                          const ProfileSpan&, CancelCheck check = {});

/// Moves the spans of FairingParams::spanTargets, each towards its own target, between these splits. Spans do not
/// touch each other, so the order does not matter; of two targets for one span the later one counts.
Result<FairedCurve> fairSpans(const NurbsCurve&, bool closed, const std::vector<double>& splits, const FairingParams&,
                              const RunContext&);

}  // namespace batten
