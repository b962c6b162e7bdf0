// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/low_pass.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/target/shape_modification.h"

namespace batten {
namespace {

/// Gaussian weights beyond so many standard deviations are nothing.
constexpr double kLowPassReach = 4.0;

/// The standard deviation that halves a wave: exp(-2 (pi sigma / wavelength)^2) = 1/2.
double sigmaOf(double wavelength) { return wavelength * std::sqrt(0.5 * std::numbers::ln2) / std::numbers::pi; }

TargetProfile smoothedProfile(const FairingSetup& setup, double wavelength) {
  const int count = setup.sampleCount();
  std::vector<double> kappa;
  for (const SpanPlace& place : setup.start.places) kappa.push_back(curvatureJet(setup.reference.at(place, 4)).kappa);
  const double spacing = setup.start.length / (setup.closed ? count : count - 1);
  const std::vector<double> smooth = lowPass(kappa, spacing, wavelength, setup.closed, setup.check);
  TargetProfile profile;
  profile.degree = 3;
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

}  // namespace

std::vector<double> lowPass(std::span<const double> values, double spacing, double wavelength, bool closed,
                            CancelCheck check) {
  const int count = static_cast<int>(values.size());
  std::vector<double> result(values.begin(), values.end());
  const double sigma = sigmaOf(wavelength) / spacing;
  if (count < 3 || !(sigma > 0.0) || !std::isfinite(sigma)) return result;
  if (closed && sigma > count) {
    // What is left of the longest wave, exp(-2 pi^2), is nothing.
    double mean = 0.0;
    for (const double v : values) mean += v / count;
    result.assign(values.size(), mean);
    return result;
  }
  const int reach =
      static_cast<int>(std::ceil(std::min(kLowPassReach * sigma, closed ? kLowPassReach * count : 1.0 * count)));
  std::vector<double> weight(static_cast<std::size_t>(reach) + 1);
  for (int k = 0; k <= reach; ++k) weight[k] = std::exp(-0.5 * (k / sigma) * (k / sigma));
  for (int i = 0; i < count && !check.isCancelled(); ++i) {
    const int low = closed ? -reach : std::max(-reach, -i), high = closed ? reach : std::min(reach, count - 1 - i);
    double w0 = 0.0, w1 = 0.0, w2 = 0.0, y0 = 0.0, y1 = 0.0;
    for (int k = low; k <= high; ++k) {
      const double w = weight[std::abs(k)], x = k / sigma;
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
    result[i] = determinant > 1e-12 * w0 * w0 && std::isfinite(line) ? line : mean;
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
  return withSetup(curve, closed, params, context,
                   [&](const std::shared_ptr<const FairingSetup>& setup, const FairingParams& within) {
                     return modifyShape(setup, smoothedProfile(*setup, within.lowPassMm), within.toleranceMm, context,
                                        {.isFiltered = true});
                   });
}

}  // namespace batten
