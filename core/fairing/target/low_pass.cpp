// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/low_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/curve/knot_operations.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/target_steps.h"
#include "core/fairing/target/shape_modification.h"

namespace batten {
namespace {

/// Gaussian weights beyond so many standard deviations are nothing.
constexpr double kLowPassReach = 4.0;
/// Places where the curvature is read, for each one of the filtered curvature: an end whose curvature shoots up between
/// two samples would else count for all of their distance.
constexpr int kFiner = 8;

/// The standard deviation that halves a wave: exp(-2 (pi sigma / wavelength)^2) = 1/2.
double sigmaOf(double wavelength) { return wavelength * std::sqrt(0.5 * std::numbers::ln2) / std::numbers::pi; }

TargetProfile smoothedProfile(const FairingSetup& setup, double wavelength) {
  const int count = setup.sampleCount(), steps = setup.closed ? count : count - 1;
  TargetProfile profile;
  profile.degree = 3;
  const auto fine = equalArcPlaces(setup.reference, kFiner * steps + (setup.closed ? 0 : 1), setup.closed, setup.check);
  if (!fine) return profile;
  std::vector<double> kappa;
  for (const SpanPlace& place : fine->places) kappa.push_back(curvatureJet(setup.reference.at(place, 4)).kappa);
  const std::vector<double> smooth =
      lowPass(kappa, fine->length / (kFiner * steps), wavelength, setup.closed, setup.check, kFiner);
  profile.valid = true;
  const int nodes = setup.closed ? count + 1 : count;
  const auto at = [&](int i) { return smooth[setup.closed ? (i + count) % count : i]; };
  for (int i = 0; i < nodes; ++i) {
    const int before = setup.closed ? i - 1 : std::max(i - 1, 0),
              after = setup.closed ? i + 1 : std::min(i + 1, count - 1);
    const double step = setup.fraction(1) * (after - before);
    profile.nodes.push_back({i + 1 == nodes ? 1.0 : setup.fraction(i), at(i), (at(after) - at(before)) / step});
  }
  return profile;
}

/// The same curve with a knot more in the middle of each interval.
Result<NurbsCurve> withFinerKnots(const NurbsCurve& curve) {
  const std::vector<double> breaks = curve.breaks();
  Result<NurbsCurve> finer = curve;
  for (std::size_t i = 1; finer && i < breaks.size(); ++i)
    finer = insertKnot(*finer, 0.5 * (breaks[i - 1] + breaks[i]), 1);
  return finer;
}

}  // namespace

std::vector<double> lowPass(std::span<const double> values, double spacing, double wavelength, bool closed,
                            CancelCheck check, int every) {
  const int count = static_cast<int>(values.size());
  std::vector<double> result;
  for (int i = 0; i < count; i += every) result.push_back(values[i]);
  const double sigma = sigmaOf(wavelength) / spacing;
  if (count < 3 || !(sigma > 0.0) || !std::isfinite(sigma)) return result;
  if (closed && sigma > count) {
    // What is left of the longest wave, exp(-2 pi^2), is nothing.
    double mean = 0.0;
    for (const double v : values) mean += v / count;
    result.assign(result.size(), mean);
    return result;
  }
  const int reach =
      static_cast<int>(std::ceil(std::min(kLowPassReach * sigma, closed ? kLowPassReach * count : 1.0 * count)));
  std::vector<double> weight(reach + 1);
  for (int k = 0; k <= reach; ++k) weight[k] = std::exp(-0.5 * (k / sigma) * (k / sigma));
  for (int i = 0; i < count && !check.isCancelled(); i += every) {
    const int low = closed ? -reach : std::max(-reach, -i), high = closed ? reach : std::min(reach, count - 1 - i);
    double w0 = 0.0, w1 = 0.0, w2 = 0.0, y0 = 0.0, y1 = 0.0;
    for (int k = low; k <= high; ++k) {
      const bool isEnd = !closed && (i + k == 0 || i + k == count - 1);  // of which half the distance is inside
      const double w = (isEnd ? 0.5 : 1.0) * weight[std::abs(k)], x = k / sigma;
      const int at = closed ? ((i + k) % count + count) % count : i + k;
      const double y = values[at];
      w0 += w;
      w1 += w * x;
      w2 += w * x * x;
      y0 += w * y;
      y1 += w * x * y;
    }
    const double determinant = w0 * w2 - w1 * w1;
    const double line = (w2 * y0 - w1 * y1) / determinant, mean = y0 / w0;
    // Too few neighbours for a slope: their mean.
    result[i / every] = determinant > 1e-12 * w0 * w0 && std::isfinite(line) ? line : mean;
  }
  return result;
}

Result<TargetProfile> lowPassedProfile(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                       CancelCheck check) {
  const auto setup = makeSetup(curve, closed, params, check);
  if (!setup) return fail(setup.error());
  return smoothedProfile(**setup, params.lowPassMm);
}

Result<FairedCurve> fairByLowPass(const NurbsCurve& curve, bool closed, const FairingParams& params,
                                  const RunContext& context) {
  const auto body = [&](const std::shared_ptr<const FairingSetup>& setup,
                        const FairingParams& within) -> Result<FairedCurve> {
    const TargetProfile profile = smoothedProfile(*setup, within.lowPassMm);
    const auto follow = [&](const std::shared_ptr<const FairingSetup>& over) {
      return modifyShape(over, profile, within.toleranceMm, context, {.isFiltered = true});
    };
    auto faired = follow(setup);
    const auto objective = targetObjective(*setup, profile);
    if (!faired || closed || !objective || faired->report.extremaAfter <= extremaAsked(*setup, *objective))
      return faired;
    // Between its knots a curve cannot always follow the profile, least at its ends: it hooks there.
    const auto finer = withFinerKnots(curve);
    const auto over = finer ? makeSetup(*finer, closed, params, context) : fail(finer.error());
    if (!over) return faired;
    auto again = follow(*over);
    return again && again->report.extremaAfter < faired->report.extremaAfter ? again : faired;
  };
  return withSetup(curve, closed, params, context, body);
}

}  // namespace batten
