// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/construct/light/end_hooks.h"
#include "core/construct/light/light_curve.h"
#include "core/construct/light/light_reference.h"

namespace batten {

/// What curves are tried.
enum class LightForms {
  All,          ///< Lines, arcs and circles, single spans of degree 2..7, quintics.
  UpToCubic,    ///< Lines, single spans of degree 2 and 3, cubics with simple knots (C2).
  UpToQuintic,  ///< Lines, single spans of degree 2..5, quintics: what can be raised to a quintic.
  Quintic,      ///< Only curves of degree 5: for sections of a longer one.
};

struct LightTask {
  LightForms forms = LightForms::All;
  bool keepStructure = true;           ///< False: whatever extrema and inflections the fewest control points give.
  std::optional<int> mostPoints = {};  ///< Tried; absent: one fewer than those of the dense curve.
  int fewestPoints = 0;                ///< Tried, where no fewer are known to be enough.
  EndHooks calm = {};                  ///< Ends that are to have none (calmRange).
};

/// One light curve for all of a reference: exact shapes, then single spans and quintics of rising number of control
/// points; LightKind::Dense when none holds what it must. Where the curvature then hooks at an open end at which it
/// is calm in the dense curve (EndHooks), a curve without such hooks is taken instead if it needs few control points
/// more.
LightCurve searchLight(const NurbsCurve& dense, const LightReference&, const LightOptions&, const LightTask&,
                       const RunContext&);

}  // namespace batten
