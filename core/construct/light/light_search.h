// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/construct/light/light_curve.h"
#include "core/construct/light/light_reference.h"

namespace batten {

/// One light curve for all of a reference: exact shapes, then single spans and quintics of rising number of control
/// points; LightKind::Dense when none holds what it must.
/// @param quintic only curves of degree 5: for sections of a longer one.
LightCurve searchLight(const NurbsCurve& dense, const LightReference&, const LightOptions&, bool quintic,
                       const RunContext&);

}  // namespace batten
