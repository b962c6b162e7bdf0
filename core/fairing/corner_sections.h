// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/fairing/fairing.h"

namespace batten {

/// A part of a curve from one sharp corner inside it to the next.
struct CornerSection {
  NurbsCurve curve;
  ProfileSpan span;         ///< Of the whole curve, by shares of the arc length.
  bool isStraight = false;  ///< Nothing is fairer.
};
/// In order. Empty for curves without a corner inside, and for closed ones that do not begin at a corner.
std::vector<CornerSection> cornerSections(const NurbsCurve&, bool closed);
/// What the parameters of a whole curve, closed or not, ask of one of its parts.
FairingParams paramsOfSection(const FairingParams& whole, const CornerSection&, bool closed);

/// As fair(), but every part between corners is made fair for itself, so that corners stay sharp and where they are:
/// what the parameters ask of a curve holds for each part. The deviation and what is needed are the largest of the
/// parts.
Result<FairedCurve> fairBetweenCorners(const NurbsCurve&, bool closed, const FairingParams&, const RunContext&,
                                       const FairingLine& line = {});

/// As fairAllTargets(), with each part's own polynomials between corners. A span that is pointed at lies in one part.
std::vector<Result<TargetOutcomes>> targetsBetweenCorners(std::span<const TargetsJob>, const RunContext&);

}  // namespace batten
