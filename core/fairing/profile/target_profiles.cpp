// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/target_profiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/polynomial_fit.h"
#include "core/fairing/profile/profile_data.h"
#include "core/fairing/profile/split_profile.h"

namespace batten {
namespace {

/// A part of a profile turns back, if it does so by more than this share of its range.
constexpr double kTurnsBack = 1e-6;

double evaluatePowers(const std::vector<double>& c, double f) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) v = v * f + c[k];
  return v;
}

std::vector<double> valuesOf(const std::vector<double>& coefficients, const std::vector<double>& perimeter) {
  std::vector<double> result;
  result.reserve(perimeter.size());
  for (const double f : perimeter) result.push_back(evaluatePowers(coefficients, f));
  return result;
}

/// The better of the rising and the falling monotone fit.
std::vector<double> fitMonotoneEitherWay(const ProfileData& data, int degree) {
  std::vector<double> best;
  double bestError = 0.0;
  for (const bool increasing : {true, false}) {
    std::vector<double> c = fitMonotonePolynomial(data.perimeter, data.values, degree, increasing);
    if (c.empty()) continue;
    const double error = meanSquareDifference(valuesOf(c, data.perimeter), data.values);
    if (best.empty() || error < bestError) {
      best = std::move(c);
      bestError = error;
    }
  }
  return best;
}

/// Whether a profile turns back nowhere but at its splits.
bool isMonotoneBetween(const std::vector<double>& perimeter, const std::vector<double>& values,
                       const std::vector<double>& splits) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double flat = kTurnsBack * (*high - *low);
  std::size_t part = 0;
  double rise = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    // Of the interval in which a split lies, both parts have something.
    const bool isNew = part < splits.size() && perimeter[i] > splits[part];
    while (part < splits.size() && perimeter[i] > splits[part]) ++part;
    const double step = isNew ? 0.0 : values[i] - values[i - 1];
    if (isNew) rise = 0.0;
    if (std::abs(step) <= flat) continue;
    if (step * rise < 0.0) return false;
    rise = step;
  }
  return true;
}

TargetProfile fitProfile(const ProfileData& data, const TargetParams& params, bool closed, int degree,
                         int controlPoints) {
  TargetProfile profile;
  profile.degree = degree;
  profile.quantity = params.quantity;
  profile.problem = data.problem;
  if (!data.problem.empty()) return profile;
  int coefficients = degree + 1;
  if (!params.splits.empty()) {
    if (params.quantity == TargetQuantity::Radius) {
      profile.problem = "Only curvature profiles can be split. Choose curvature, or remove the splits.";
      return profile;
    }
    SplitProfile split = fitSplitProfile(data.perimeter, data.kappa, params.splits, degree, params.monotone, closed);
    profile.nodes = std::move(split.nodes);
    coefficients = split.coefficients;
  } else {
    profile.coefficients = closed            ? fitPeriodicPolynomial(data.perimeter, data.values, degree)
                           : params.monotone ? fitMonotoneEitherWay(data, degree)
                                             : fitPolynomial(data.perimeter, data.values, degree);
  }
  if (profile.coefficients.empty() && profile.nodes.empty()) {
    profile.problem = "No polynomial of this degree could be fitted.";
    return profile;
  }
  profile.valid = true;
  std::vector<double> fitted;
  for (const double f : data.perimeter) fitted.push_back(profile.value(f));
  profile.isMonotone = profile.nodes.empty() ? isMonotonePolynomial(profile.coefficients)
                                             : isMonotoneBetween(data.perimeter, fitted, params.splits);
  judgeProfile(profile, data, fitted, coefficients, controlPoints);
  return profile;
}

}  // namespace

std::optional<Error> validate(const TargetParams& params) {
  if (params.samples < 101 || params.samples > 2001) {
    return Error{ErrorCode::BadParameter,
                 "Target samples must lie between 101 and 2001, not at " + std::to_string(params.samples) + ".",
                 {}};
  }
  for (std::size_t i = 0; i < params.splits.size(); ++i) {
    if (params.splits[i] > (i > 0 ? params.splits[i - 1] : 0.0) && params.splits[i] < 1.0) continue;
    return Error{ErrorCode::BadParameter, "The places where a profile is split must ascend between 0 and 1.", {}};
  }
  return std::nullopt;
}

double TargetProfile::value(double f) const {
  if (nodes.empty()) return evaluatePowers(coefficients, f);
  const auto above =
      std::upper_bound(nodes.begin(), nodes.end(), f, [](double at, const ProfileNode& n) { return at < n.f; });
  if (above == nodes.begin()) return nodes.front().value;
  const ProfileNode& a = *(above - 1);
  if (above == nodes.end()) return a.value;
  const double h = above->f - a.f, t = (f - a.f) / h, u = 1.0 - t;
  return u * u * ((1.0 + 2.0 * t) * a.value + t * h * a.slope) +
         t * t * ((3.0 - 2.0 * t) * above->value - u * h * above->slope);
}

double TargetProfile::curvatureAt(double f) const {
  const double v = value(f);
  if (quantity == TargetQuantity::Curvature) return v;
  const double kappa = 1.0 / v;
  return std::isfinite(kappa) ? kappa : 0.0;
}

TargetProfile fitTarget(const NurbsCurve& curve, const TargetParams& params, bool closed, int degree) {
  const CurvatureSamples samples = sampledCurvature(curve, params.samples);
  const ProfileData data = profileData(samples.perimeters(), samples.kappa, extent(curve), params.quantity);
  return fitProfile(data, params, closed, degree, curve.controlPointCount());
}

TargetSet fitTargets(const NurbsCurve& curve, const TargetParams& params, bool closed) {
  TargetSet set;
  if (curve.isEmpty()) {
    for (int d = 1; d <= kMostTargetDegree; ++d) {
      set.profiles[d - 1].degree = d;
      set.profiles[d - 1].problem = "There is no curve.";
    }
    return set;
  }
  const CurvatureSamples samples = sampledCurvature(curve, params.samples);
  const ProfileData data = profileData(samples.perimeters(), samples.kappa, extent(curve), params.quantity);
  set.samples = samples.places();
  set.comparesCurvature = data.bendsBothWays;
  for (int degree = 1; degree <= kMostTargetDegree; ++degree) {
    const int at = degree - 1;
    set.profiles[at] = fitProfile(data, params, closed, degree, curve.controlPointCount());
    const TargetProfile& profile = set.profiles[at];
    if (!profile.valid) continue;
    const std::optional<int> best = set.recommendedDegree;
    if (!best || hasLowerAicc(profile, set.profiles[*best - 1])) set.recommendedDegree = degree;
  }
  return set;
}

}  // namespace batten
