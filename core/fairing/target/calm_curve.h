// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/cancel_check.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"

namespace batten {

/// A profile of more polynomials says nothing that the curve does not say itself.
inline constexpr int kMostSplits = 24;

/// The curve without the tremor of the hand, where it has one: more curvature extrema than a target could have splits,
/// and less than half of them in the nearest curve over so few knots that it explains the curve best (BIC, the curve's
/// control points being the data; AICc, which charges less for a knot, keeps more of the tremor). It depends on the
/// curve and its held ends alone, not on a tolerance. Nothing where the parameters ask for one polynomial, for radii or
/// for moved edge lengths, which are fitted to the curve itself as in the papers.
std::optional<NurbsCurve> withoutTremor(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});

/// The curve that the profiles of targets are fitted to.
NurbsCurve targetStart(const NurbsCurve&, bool closed, const FairingParams&, CancelCheck check = {});

}  // namespace batten
