// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/profile_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/conventions.h"
#include "core/curve/curvature.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/similarity.h"

namespace batten {
namespace {

/// |rho| counts as at most this many extents of the curve.
constexpr double kRadiusLimit = 10.0;
constexpr double kExactShare = 1e-6;  // of the values, rms: a nearer fit counts as this, or AICc would have no bound
constexpr int kLeastCompared = 121;   // samples

double clippedRadius(double kappa, double largest) {
  return std::abs(kappa) * largest > 1.0 ? 1.0 / kappa : std::copysign(largest, kappa);
}

}  // namespace

ProfileData profileData(std::vector<double> perimeter, std::vector<double> kappa, double extentMm,
                        TargetQuantity quantity) {
  ProfileData data;
  data.perimeter = std::move(perimeter);
  data.kappa = std::move(kappa);
  data.largestRadius = kRadiusLimit * extentMm;
  bool left = false, right = false;
  for (const double one : data.kappa) {
    data.radius.push_back(clippedRadius(one, data.largestRadius));
    left = left || one * extentMm > kStraightCurvature;
    right = right || one * extentMm < -kStraightCurvature;
  }
  data.bendsBothWays = left && right;
  if (quantity == TargetQuantity::Curvature) {
    data.values = data.kappa;
    return data;
  }
  if (left && right) {
    data.problem =
        "The curvature changes sign: a radius has no profile there. Under More, choose Profile of: Curvature.";
  } else if (!left && !right) {
    data.problem = "The curve is straight: its radius has no value. Under More, choose Profile of: Curvature.";
  }
  // Straight parts of a curve that turns one way take that way's sign.
  data.values = data.radius;
  for (double& rho : data.values) rho = right ? -std::abs(rho) : std::abs(rho);
  return data;
}

double similarityToSketch(const NurbsCurve& modified, const NurbsCurve& sketched) {
  if (modified.isEmpty() || sketched.isEmpty()) return 0.0;
  const int count =
      std::max<int>(static_cast<int>(modified.breaks().size()), static_cast<int>(sketched.breaks().size()));
  const auto dataOf = [&](const NurbsCurve& curve) {
    const CurvatureSamples samples = sampledCurvature(curve, std::max(kLeastCompared, 4 * count + 1));
    return profileData(samples.perimeters(), samples.kappa, extent(curve), TargetQuantity::Curvature);
  };
  const ProfileData a = dataOf(modified), b = dataOf(sketched);
  return b.bendsBothWays ? similarity(a.kappa, b.kappa) : similarity(a.radius, b.radius);
}

double meanSquareDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return a.empty() ? 0.0 : sum / static_cast<double>(a.size());
}

void judgeProfile(TargetProfile& profile, const ProfileData& data, const std::vector<double>& fitted,
                  int coefficientCount, int controlPoints) {
  if (data.bendsBothWays) {
    profile.similarity = similarity(fitted, data.kappa);
    profile.pearson = pearson(fitted, data.kappa);
  } else {
    std::vector<double> radius;
    radius.reserve(fitted.size());
    for (const double value : fitted) {
      radius.push_back(profile.quantity == TargetQuantity::Curvature
                           ? clippedRadius(value, data.largestRadius)
                           : std::clamp(value, -data.largestRadius, data.largestRadius));
    }
    profile.similarity = similarity(radius, data.radius);
    profile.pearson = pearson(radius, data.radius);
  }
  const double square = meanSquareDifference(fitted, data.values);
  const auto [low, high] = std::minmax_element(data.values.begin(), data.values.end());
  const double size = std::max(std::abs(*low), std::abs(*high));
  // A circle has no range: what is left is rounding and counts as a perfect fit.
  profile.rmsPercent = *high - *low > 1e-12 * size ? 100.0 * std::sqrt(square) / (*high - *low) : 0.0;
  const double scale = meanSquareDifference(data.values, std::vector<double>(data.values.size(), 0.0));
  profile.aicc = aicc(std::max(square, kExactShare * kExactShare * scale), coefficientCount - 1, controlPoints);
}

}  // namespace batten
