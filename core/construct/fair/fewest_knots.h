// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"
#include "core/curve/uniform_quintic.h"

namespace batten {

/// What is asked at one station.
struct FewestKnotsLimit {
  double distancePx = 0.0;  ///< > 0: farthest from the curve …
  double kappaSigma = 0.0;  ///< [1/px] … and noise of the curvature there.
};
/// What a curve with fewer control points has to keep of the one that it stands for; px.
struct FewestKnotsLimits {
  std::span<const FewestKnotsLimit> stations;               ///< At `checkStations(curve, perSpan)`.
  int perSpan = 4;                                          ///< Of these stations.
  double kappaShare = 0.5;                                  ///< Part of the noise by which the curvature may differ.
  Vec2 startShift = Vec2::Zero(), endShift = Vec2::Zero();  ///< As UniformQuintic::toNurbs; open curves.
};

struct FewestKnotsResult {
  NurbsCurve curve;      ///< px, clamped; ends exactly where the full curve, shifted, does; closed: periodic.
  double movedPx = 0.0;  ///< Farthest that it lies from the full curve.
};

/// The quintic with the fewest spans that stays within the limits and whose curvature has as many extrema as that of
/// the full curve: least squares on knots that share out the sixth derivative evenly (de Boor, A Practical Guide to
/// Splines, ch. XII), their number found by trial. The last step of the fair fit (fair_finish.h). Absent when nothing
/// is gained.
std::optional<FewestKnotsResult> withFewestKnots(const UniformQuintic& full, const FewestKnotsLimits&,
                                                 CancelCheck check = {});

}  // namespace batten
