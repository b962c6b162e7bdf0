// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// Low-pass of samples at equal distances: local straight lines with Gaussian weights, so that ends and ramps stay
/// where they are (a plain mean would pull the ends inwards). Inside the data this is a Gaussian filter; a wave of
/// length `wavelength` keeps half its height.
/// @param spacing,wavelength in one unit, > 0.
/// @param closed the last sample is followed by the first.
/// @param every the result has the first sample and every so manieth after it.
std::vector<double> lowPass(std::span<const double> values, double spacing, double wavelength, bool closed,
                            CancelCheck check = {}, int every = 1);

/// That curvature over arc length as a profile. @return what makeSetup says of curves that cannot be made fair.
Result<TargetProfile> lowPassedProfile(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});

/// Towards the sketched curve's curvature over arc length without its short waves (001 section 7: low-pass filtering of
/// the curvature), as far as the tolerance allows. An open curve that would turn back more often than the filtered
/// curvature gets a knot more between every two.
Result<FairedCurve> fairByLowPass(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&);

}  // namespace batten
