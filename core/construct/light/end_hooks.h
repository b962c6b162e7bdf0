// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/construct/light/light_fit.h"
#include "core/construct/light/light_reference.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// Ends of an open light curve at which its curvature changes sharply where the dense curve's is calm.
struct EndHooks {
  bool atStart = false, atEnd = false;

  bool any() const { return atStart || atEnd; }
};

/// Curvatures that an end may have without a hook, if the curvature beside it is that of the dense curve; or so much of
/// a share of them.
CurvatureRange calmRange(const LightReference& dense, bool atEnd, double share);

/// Both curvatures are looked at along the first and the last tenth of the length. @pre the reference is open and the
/// curve lies along it.
EndHooks endHooks(const NurbsCurve& light, const LightReference& dense);

}  // namespace batten
