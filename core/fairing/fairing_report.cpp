// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/fairing_report.h"

#include <utility>

#include "core/curve/curvature.h"

namespace batten {

FairedCurve unchanged(const NurbsCurve& curve, bool closed, Termination why, std::string note) {
  FairedCurve result;
  result.curve = curve;
  result.report.why = why;
  result.report.note = std::move(note);
  if (!curve.isEmpty()) result.report.extremaBefore = result.report.extremaAfter = countedExtrema(curve, closed);
  return result;
}

}  // namespace batten
