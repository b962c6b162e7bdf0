// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/profile/target_profiles.h"
#include "core/fairing/target/target_courses.h"

namespace batten {

/// Moves the control points until the curvature follows the profile as far as the tolerance allows (000 VII, 003
/// section 4): Levenberg-Marquardt with the end points pinned in a null-space basis, at fidelity weights that do not
/// depend on the tolerance (TargetSteps). Periodic curves stay periodic (`closed`). Knots stay as they are, but for a
/// sketch that trembles: the tremor of many knots stops it, so it is followed over a few knots too. Of the curves
/// within the tolerance the one with the fewest curvature extrema is taken, of these the nearest to the profile; none
/// has more than the sketch, or than a profile that was drawn. Never returns a curve that leaves the tolerance.
Result<FairedCurve> modifyShape(const NurbsCurve&, bool closed, const TargetProfile&, const FairingParams&,
                                const RunContext&);

/// How many curvature extrema count as none too many, beside the nearness to the profile.
enum class ExtremaAsked {
  UpToSketch,  ///< Those of the profile, but no more than the sketch has.
  OfProfile,   ///< Those of the profile: the user has drawn it.
};

struct ModificationEffort {
  ExtremaAsked asked = ExtremaAsked::UpToSketch;
  bool onlyIfMet = false;   ///< Where the tolerance does not allow the whole target, the sketch comes back at once.
  bool onlyNeed = false;    ///< Only what the target needs is asked for, where that is not far above the tolerance.
  bool isFiltered = false;  ///< The profile is the curve's own curvature without short waves: notes advise so.
};

/// The same along courses that several modifications share, on a setup that several fairings share.
Result<FairedCurve> modifyShape(TargetCourses& target, double toleranceMm, ModificationEffort effort = {});
Result<FairedCurve> modifyShape(const std::shared_ptr<const FairingSetup>& setup, const TargetProfile& profile,
                                double toleranceMm, const RunContext& context, ModificationEffort effort = {});

/// The tolerance that meets the target: [mm]. Nothing where that is much more than `mostMm`, or where the curve cannot
/// be moved.
std::optional<double> neededWithin(TargetCourses& target, double mostMm);

/// The target could have been met over other spans, but with more extrema.
void noteMetOverMoreSpans(FairingReport&);

}  // namespace batten
