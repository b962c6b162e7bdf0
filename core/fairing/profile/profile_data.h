// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/fairing/profile/target_profiles.h"

namespace batten {

/// What a profile is fitted to.
struct ProfileData {
  // By sample. Not one struct a sample: fits and similarities are of whole vectors.
  std::vector<double> perimeter, kappa, radius;
  std::vector<double> values;  ///< Of the quantity that is fitted.
  double largestRadius = 0.0;  ///< [mm]
  bool bendsBothWays = false;  ///< Somewhere the radius has no end.
  std::string problem;         ///< Why no profile can be fitted; empty: it can.
};
/// @param extentMm of the whole curve.
ProfileData profileData(std::vector<double> perimeter, std::vector<double> kappa, double extentMm, TargetQuantity);

/// Fills in how near a valid profile comes to the data: similarity, Pearson r, rms and AICc.
/// @param fitted its values at the data's places.
void judgeProfile(TargetProfile&, const ProfileData&, const std::vector<double>& fitted, int coefficientCount,
                  int controlPoints);

/// S (003 section 6) of a modified curve against the curve that it was made of: of their radii over the perimeter, both
/// rescaled to 1, or where the curve bends both ways and its radius has no end, of their curvatures.
double similarityToSketch(const NurbsCurve& modified, const NurbsCurve& sketched);

/// 0 of none. @pre `b` has as many values as `a`.
double meanSquareDifference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace batten
