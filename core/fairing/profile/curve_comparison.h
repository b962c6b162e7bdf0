// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// The shape of a curve without its place, size and turn: radius and curvature over the perimeter, which is rescaled to
/// 1 (003 section 5, Fig. 6). Radii are limited to ten extents of the curve, for straight parts have none.
struct ShapeProfile {
  std::vector<double> radius;     ///< rho / length, signed, at equal shares of the perimeter.
  std::vector<double> curvature;  ///< kappa * length.
  bool closed = false;            ///< The last sample is followed by the first.
};
inline constexpr int kShapeSamples = 360;  // along a curve, at equal arc length

/// Absent (empty) for a curve without length.
ShapeProfile shapeProfile(const NurbsCurve&, bool closed);
/// The same of a target profile, for a curve of this length and extent [mm].
ShapeProfile shapeProfile(const TargetProfile&, bool closed, double lengthMm, double extentMm);

/// How alike two curves are, in the best of all ways to lay one over the other.
struct ShapeComparison {
  double similarity = 0.0;  ///< S of the radii (003 Eq 14), -1..1.
  double pearson = 0.0;     ///< Pearson r of the radii, -1..1.
  double curvatureSimilarity = 0.0,
         curvaturePearson = 0.0;  ///< The same of the curvatures, which have no end on straight parts.
  bool mirrored = false;          ///< The second curve was reflected,
  bool reversed = false;          ///< run through from its end,
  double shift = 0.0;             ///< and begun at this share of its perimeter (closed curves).
  ShapeProfile first, second;     ///< As compared, laid over each other.
};
/// Correlation matching (003 section 5): independent of place, size, rotation and reflection, of the direction in which
/// the curves were drawn and of where a closed curve begins. The way with the largest S counts. S alone rises for any
/// two radii of one sign, so Pearson's r stands beside it.
ShapeComparison compareShapes(const ShapeProfile& first, const ShapeProfile& second);

}  // namespace batten
