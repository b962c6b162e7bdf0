// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/natural_spans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/curve/curvature_structure.h"
#include "core/fairing/profile/curvature_samples.h"

namespace batten {
namespace {

/// [mm] Tolerances at which the natural spans change.
constexpr std::array kSeries = {20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
/// Part of the tolerance by which the removal of an extremum must move the curve, for it to part two spans.
constexpr double kTriflingShare = 0.1;
/// The series holds a tolerance that rounding has made a trifle smaller.
constexpr double kSeriesRounding = 1.0 - 1e-9;
constexpr int kLeastSamples = 241;  // along a curve
/// Share of the length below which a part is none.
constexpr double kLeastSpan = 5e-3;

class NaturalSpans {
 public:
  NaturalSpans(const NurbsCurve& curve, bool closed) : closed_(closed) {
    if (curve.isEmpty()) return;
    samples_ = sampledCurvature(curve, kLeastSamples);
    if (!(samples_.lengthMm > 0.0)) return;
    // The last sample of a closed curve is the first one.
    const int count = samples_.count() - (closed ? 1 : 0);
    std::vector<double> s;
    s.reserve(count);
    for (int i = 0; i < count; ++i) s.push_back(samples_.perimeter(i) * samples_.lengthMm);
    levels_ = structureLevels(s, std::span(samples_.kappa).first(count), samples_.lengthMm, closed);
  }

  std::vector<double> splits(double toleranceMm) const {
    std::vector<double> result;
    if (levels_.empty()) return result;
    std::size_t level = 0;
    while (level + 1 < levels_.size() && levels_[level + 1].estimateMm < kTriflingShare * toleranceMm) ++level;
    const auto& extrema = levels_[level].structure.extrema;
    if (closed_ && areTrifles(extrema, kTriflingShare * toleranceMm)) return result;
    for (const StructureExtremum& extremum : extrema) result.push_back(samples_.perimeter(extremum.sample));
    std::sort(result.begin(), result.end());
    std::erase_if(result, [this](double f) { return f <= (closed_ ? 0.0 : kLeastSpan) || f >= 1.0 - kLeastSpan; });
    const auto tooNear = [](double a, double b) { return b - a < kLeastSpan; };
    result.erase(std::unique(result.begin(), result.end(), tooNear), result.end());
    return result;
  }

 private:
  /// A closed curve keeps four extrema; of one that is all but a circle they are nothing.
  bool areTrifles(const std::vector<StructureExtremum>& extrema, double leastMm) const {
    constexpr std::size_t kFewest = 4;  // extrema of a closed curve
    if (extrema.size() > kFewest) return false;
    for (std::size_t i = 0; i < extrema.size(); ++i) {
      const int a = extrema[i].sample, b = extrema[(i + 1) % extrema.size()].sample;
      double share = samples_.perimeter(b) - samples_.perimeter(a);
      if (share <= 0.0) share += 1.0;
      const double half = share * samples_.lengthMm;
      const double moved =
          std::abs(samples_.kappa[b] - samples_.kappa[a]) * half * half / (2.0 * std::numbers::pi * std::numbers::pi);
      if (moved >= leastMm) return false;
    }
    return true;
  }

  bool closed_;
  CurvatureSamples samples_;
  std::vector<StructureLevel> levels_;
};

/// Of the series, this one and the smaller ones.
auto seriesFrom(double toleranceMm) {
  return std::find_if(kSeries.begin(), kSeries.end() - 1,
                      [&](double one) { return one * kSeriesRounding <= toleranceMm; });
}

}  // namespace

bool hasNaturalSpans(const TargetParams& params) {
  return params.splits.empty() && params.spans == TargetSpans::Natural && params.quantity == TargetQuantity::Curvature;
}

std::vector<double> naturalSplits(const NurbsCurve& curve, bool closed, double toleranceMm) {
  return NaturalSpans(curve, closed).splits(*seriesFrom(toleranceMm));
}

std::vector<SpanLevel> naturalSpanLevels(const NurbsCurve& curve, bool closed) {
  const NaturalSpans spans(curve, closed);
  std::vector<SpanLevel> levels;
  for (const double tolerance : kSeries) {
    auto splits = spans.splits(tolerance);
    if (levels.empty() || splits != levels.back().splits) levels.push_back({tolerance, std::move(splits)});
    levels.back().fromMm = tolerance;
  }
  levels.back().fromMm = 0.0;
  return levels;
}

std::size_t levelOf(std::span<const SpanLevel> levels, double toleranceMm) {
  const auto level = std::find_if(levels.begin(), levels.end(),
                                  [&](const SpanLevel& one) { return one.fromMm * kSeriesRounding <= toleranceMm; });
  return level - levels.begin();
}

ProfileSpan spanBetween(const std::vector<double>& splits, double at, bool closed) {
  if (splits.empty() || (closed && splits.size() < 2)) return {};
  const auto above = std::upper_bound(splits.begin(), splits.end(), at);
  if (!closed) return {above == splits.begin() ? 0.0 : *(above - 1), above == splits.end() ? 1.0 : *above};
  if (above == splits.begin() || above == splits.end()) return {splits.back(), splits.front() + 1.0};
  return {*(above - 1), *above};
}

}  // namespace batten
