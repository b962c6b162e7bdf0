// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/left_as_drawn.h"

namespace batten {
namespace {

/// Of the tolerance: a curve that moves less than this has not been faired.
constexpr double kStillShare = 1e-3;

}  // namespace

bool isChanged(const TracedCurve& curve) { return !curve.faired.isEmpty() && !(curve.faired == curve.sketched); }

bool isLeftAsDrawn(const TracedCurve& curve) {
  if (!curve.included || curve.faired.isEmpty() || curve.fairingUsed.mode == FairingMode::None) return false;
  if (!isChanged(curve)) return true;
  // A rounded corner takes a piece of the curve away, whatever fairing did.
  const auto isSameEnd = [&](double a, double b) {
    return (curve.faired.point(a) - curve.sketched.point(b)).norm() <= kStillShare * curve.fairingUsed.toleranceMm;
  };
  return curve.fairing.maxDeviationMm <= kStillShare * curve.fairingUsed.toleranceMm &&
         isSameEnd(curve.faired.start(), curve.sketched.start()) && isSameEnd(curve.faired.end(), curve.sketched.end());
}

std::string leftAsDrawnReason(const TracedCurve& curve) {
  if (!isLeftAsDrawn(curve)) return {};
  if (!curve.fairing.note.empty()) return curve.fairing.note;
  if (curve.construct.isCircle) return "Unchanged: exact circle.";
  if (curve.construct.isLine) return "Unchanged: exact line.";
  if (curve.isSimplified() && curve.sketched.isRational()) return "Unchanged: exact arc.";
  switch (curve.fairingUsed.mode) {
    case FairingMode::Target:
      return "Unchanged: no move within the tolerance brings the curve closer to the target.";
    case FairingMode::Tolerance:
      return curve.fairingUsed.tolerancePolicy == TolerancePolicy::AsNeeded
                 ? "Unchanged: every extremum of the curvature is supported by the line."
                 : "Unchanged: no move within the tolerance reduces the variation of curvature.";
    case FairingMode::Monotone:
      return curve.fairingUsed.keepExtrema.count.value_or(0) > 0 || !curve.fairingUsed.keptAt.empty()
                 ? "Unchanged: it has no more curvature extrema than are to be kept."
                 : "Unchanged: it has no curvature extremum to remove.";
    case FairingMode::LowPass:
      return "Unchanged: it has no waves below this wavelength.";
    case FairingMode::None:
      break;
  }
  return {};
}

}  // namespace batten
