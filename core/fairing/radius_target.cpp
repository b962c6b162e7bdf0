// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/radius_target.h"

#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "core/curve/arc_length.h"
#include "core/curve/span_curve.h"
#include "core/fairing/polynomial_fit.h"
#include "core/fairing/similarity.h"
#include "core/fairing/split_profile.h"

namespace batten {
namespace {

constexpr int kSamplesPerSpan = 4;
/// |rho| counts as at most this many extents of the curve.
constexpr double kLargestRadius = 10.0;
constexpr double kExactShare = 1e-6;

double evaluatePowers(const std::vector<double>& c, double f) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) v = v * f + c[k];
  return v;
}

double clippedRadius(double kappa, double largest) {
  return std::abs(kappa) * largest > 1.0 ? 1.0 / kappa : std::copysign(largest, kappa);
}

struct Data {
  std::vector<double> perimeter, kappa, radius, values;
  double largestRadius = 0.0;
  std::string problem;
};

/// Curvature at equal arc length. Plain B-splines take the fast way; what it refuses, the general one.
void sampleCurvature(const NurbsCurve& curve, const TargetParams& params, Data& data) {
  const int spans = static_cast<int>(curve.breaks().size()) - 1;
  const int count = std::max(params.samples, kSamplesPerSpan * spans + 1);
  for (int i = 0; i < count; ++i) data.perimeter.push_back(static_cast<double>(i) / (count - 1));
  data.kappa.assign(count, 0.0);
  if (!curve.isRational() && curve.degree() >= 2 && curve.degree() <= kMaxDegree) {
    const SpanBasis basis(curve.degree(), curve.knots(), curve.controlPointCount(), 0);
    const SpanCurve fast(basis, curve.controlPoints());
    if (const auto places = equalArcPlaces(fast, count, false)) {
      for (std::size_t i = 0; i < data.kappa.size(); ++i) {
        const Jet jet = fast.at(places->places[i], 2);
        const double speed = jet[1].norm(), kappa = cross(jet[1], jet[2]) / (speed * speed * speed);
        data.kappa[i] = std::isfinite(kappa) ? kappa : 0.0;
      }
      return;
    }
  }
  const std::vector<CurveSample> samples = sampleByArcLength(curve, count);
  for (std::size_t i = 0; i < samples.size() && i < data.kappa.size(); ++i) data.kappa[i] = samples[i].kappa;
}

Data collect(const NurbsCurve& curve, const TargetParams& params) {
  Data data;
  sampleCurvature(curve, params, data);
  const double size = extent(curve);
  data.largestRadius = kLargestRadius * size;
  bool left = false, right = false;
  for (const double kappa : data.kappa) {
    data.radius.push_back(clippedRadius(kappa, data.largestRadius));
    left = left || kappa * size > kStraightCurvature;
    right = right || kappa * size < -kStraightCurvature;
  }
  if (params.quantity == TargetQuantity::Curvature) {
    data.values = data.kappa;
    return data;
  }
  if (left && right) {
    data.problem =
        "The curvature changes sign: a radius has no profile there. Use curvature, or split at the inflection.";
  } else if (!left && !right) {
    data.problem = "The curve is straight: its radius has no value. Use curvature.";
  }
  // Straight parts of a curve that turns one way take that way's sign.
  data.values = data.radius;
  for (double& rho : data.values) rho = right ? -std::abs(rho) : std::abs(rho);
  return data;
}

double meanSquare(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return a.empty() ? 0.0 : sum / static_cast<double>(a.size());
}

std::vector<double> valuesOf(const std::vector<double>& coefficients, const std::vector<double>& perimeter) {
  std::vector<double> result;
  result.reserve(perimeter.size());
  for (const double f : perimeter) result.push_back(evaluatePowers(coefficients, f));
  return result;
}

/// The better of the rising and the falling monotone fit.
std::vector<double> fitMonotoneEitherWay(const Data& data, int degree) {
  std::vector<double> best;
  double bestError = 0.0;
  for (const bool increasing : {true, false}) {
    std::vector<double> c = fitMonotonePolynomial(data.perimeter, data.values, degree, increasing);
    if (c.empty()) continue;
    const double error = meanSquare(valuesOf(c, data.perimeter), data.values);
    if (best.empty() || error < bestError) {
      best = std::move(c);
      bestError = error;
    }
  }
  return best;
}

TargetProfile fitProfile(const Data& data, const TargetParams& params, bool closed, int degree, int controlPoints) {
  TargetProfile profile;
  profile.degree = degree;
  profile.quantity = params.quantity;
  profile.problem = data.problem;
  if (!data.problem.empty()) return profile;
  int coefficients = degree + 1;
  if (!params.splits.empty()) {
    if (params.quantity == TargetQuantity::Radius) {
      profile.problem = "Only profiles of the curvature can be split. Choose curvature, or take the splits away.";
      return profile;
    }
    profile.nodes =
        fitSplitProfile(data.perimeter, data.kappa, params.splits, degree, params.monotone, closed, coefficients);
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
                                             : std::is_sorted(fitted.begin(), fitted.end()) ||
                                                   std::is_sorted(fitted.rbegin(), fitted.rend());
  std::vector<double> radius;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const double rho = params.quantity == TargetQuantity::Curvature
                           ? clippedRadius(fitted[i], data.largestRadius)
                           : std::clamp(fitted[i], -data.largestRadius, data.largestRadius);
    radius.push_back(rho);
  }
  profile.similarity = similarity(radius, data.radius);
  profile.pearson = pearson(radius, data.radius);
  const double square = meanSquare(fitted, data.values);
  const auto [low, high] = std::minmax_element(data.values.begin(), data.values.end());
  const double size = std::max(std::abs(*low), std::abs(*high));
  // A circle has no range: what is left is rounding and counts as a perfect fit.
  profile.rmsPercent = *high - *low > 1e-12 * size ? 100.0 * std::sqrt(square) / (*high - *low) : 0.0;
  const double scale = meanSquare(data.values, std::vector<double>(data.values.size(), 0.0));
  profile.aicc = aicc(std::max(square, kExactShare * kExactShare * scale), coefficients - 1, controlPoints);
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

TargetSet fitTargets(const NurbsCurve& curve, const TargetParams& params, bool closed) {
  TargetSet set;
  if (curve.isEmpty()) {
    for (int d = 1; d <= 6; ++d) {
      set.profiles[d - 1].degree = d;
      set.profiles[d - 1].problem = "There is no curve.";
    }
    return set;
  }
  const Data data = collect(curve, params);
  set.perimeter = data.perimeter;
  set.kappa = data.kappa;
  for (int degree = 1; degree <= 6; ++degree) {
    const auto at = static_cast<std::size_t>(degree - 1);
    set.profiles[at] = fitProfile(data, params, closed, degree, curve.controlPointCount());
    const TargetProfile& profile = set.profiles[at];
    if (!profile.valid) continue;
    const auto best = static_cast<std::size_t>(std::max(set.recommendedDegree, 1) - 1);
    if (set.recommendedDegree == 0 || profile.aicc < set.profiles[best].aicc) set.recommendedDegree = degree;
  }
  return set;
}

}  // namespace batten
