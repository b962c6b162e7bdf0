// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/termination.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

struct FairingReport {
  Termination why = Termination::NotRun;
  std::string note;  ///< For the user; empty when all went as asked.
  int iterations = 0;
  double objectiveBefore = 0.0, objectiveAfter = 0.0;  ///< Relative curvature misfit, or integral of (dkappa/ds)^2.
  double maxDeviationMm = 0.0;                         ///< From the sketched curve.
  double neededMm = 0.0;        ///< Target mode: deviation that meeting the target fully would take.
  bool withinTolerance = true;  ///< Target mode: the target was met within the tolerance.
  int extremaBefore = 0, extremaAfter = 0;
  double noiseMm = 0.0;  ///< Tolerance mode, as needed: standard deviation of a stretch of 8 px of the line's
                         ///< points; 0 = not known.
};

struct FairedCurve {
  NurbsCurve curve;
  FairingReport report;
};

/// The curve as sketched, with the reason why nothing was done.
FairedCurve unchanged(const NurbsCurve& curve, bool closed, Termination why, std::string note);

}  // namespace batten
