// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/construct/light/light_curve.h"

namespace batten {

/// The light curve of a dense one (makeLight); of one with sharp corners inside each part between them, and the parts
/// as one curve again. None where nothing lighter was found, and when cancelled.
std::optional<NurbsCurve> lightBetweenCorners(const NurbsCurve& dense, bool closed, const LightOptions&,
                                              const RunContext&);

/// Curves of any degree that follow each other as one of the highest of their degrees, with a corner (or what there is
/// of one) at every joint. None for rational curves, and where they do not meet within `tolerance`.
std::optional<NurbsCurve> joinedAtCorners(const std::vector<NurbsCurve>& parts, double tolerance);

}  // namespace batten
