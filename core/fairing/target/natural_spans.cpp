// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/natural_spans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/curve/curvature.h"
#include "core/curve/curvature_structure.h"
#include "core/fairing/profile/curvature_samples.h"

namespace batten {
namespace {

/// [mm] Moves that part the levels of splits.
constexpr std::array kSplitSeries = {0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.005, 0.01,
                                     0.02,   0.05,   0.1,    0.2,   0.5,   1.0,   2.0};
/// An extremum is natural whose removal moves the curve by this [mm], and by this share of its size.
constexpr double kNaturalMoveMm = 0.02, kNaturalShare = 1e-4;
constexpr int kLeastSamples = 241;
/// Share of the length below which a part is none.
constexpr double kLeastSpan = 5e-3;

class NaturalSpans {
 public:
  NaturalSpans(const NurbsCurve& curve, bool closed) : closed_(closed) {
    if (curve.isEmpty()) return;
    samples_ = sampledCurvature(curve, kLeastSamples);
    if (!(samples_.lengthMm > 0.0)) return;
    // The last sample of a closed curve is the first one.
    const std::size_t count = samples_.kappa.size() - (closed ? 1 : 0);
    std::vector<double> s;
    for (std::size_t i = 0; i < count; ++i) s.push_back(samples_.perimeter[i] * samples_.lengthMm);
    levels_ = structureLevels(s, std::span(samples_.kappa).first(count), samples_.lengthMm, closed);
  }

  std::vector<double> splits(double leastMm) const {
    std::vector<double> result;
    if (levels_.empty()) return result;
    std::size_t level = 0;
    while (level + 1 < levels_.size() && levels_[level + 1].estimateMm < leastMm) ++level;
    const auto& extrema = levels_[level].structure.extrema;
    if (closed_ && areTrifles(extrema, leastMm)) return result;
    for (const StructureExtremum& extremum : extrema) result.push_back(samples_.perimeter[extremum.sample]);
    std::sort(result.begin(), result.end());
    std::erase_if(result, [this](double f) { return f <= (closed_ ? 0.0 : kLeastSpan) || f >= 1.0 - kLeastSpan; });
    const auto tooNear = [](double a, double b) { return b - a < kLeastSpan; };
    result.erase(std::unique(result.begin(), result.end(), tooNear), result.end());
    return result;
  }

 private:
  /// A closed curve keeps four extrema; of one that is all but a circle they are nothing.
  bool areTrifles(const std::vector<StructureExtremum>& extrema, double leastMm) const {
    constexpr std::size_t kFewest = 4;
    if (extrema.size() > kFewest) return false;
    for (std::size_t i = 0; i < extrema.size(); ++i) {
      const int a = extrema[i].sample, b = extrema[(i + 1) % extrema.size()].sample;
      double share = samples_.perimeter[b] - samples_.perimeter[a];
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

double naturalMoveMm(const NurbsCurve& curve) {
  return curve.isEmpty() ? kNaturalMoveMm : std::max(kNaturalMoveMm, kNaturalShare * extent(curve));
}

}  // namespace

std::vector<double> significantSplits(const NurbsCurve& curve, bool closed, double leastMm) {
  return NaturalSpans(curve, closed).splits(leastMm);
}

std::vector<double> naturalSplits(const NurbsCurve& curve, bool closed) {
  return std::move(naturalSplitLevels(curve, closed).front().splits);
}

std::vector<SplitLevel> naturalSplitLevels(const NurbsCurve& curve, bool closed) {
  const NaturalSpans spans(curve, closed);
  const double natural = naturalMoveMm(curve);
  std::vector<SplitLevel> levels;
  const auto add = [&levels](std::vector<double> splits) {
    if (std::ssize(splits) <= kMostSplits && (levels.empty() || splits.size() < levels.back().splits.size()))
      levels.push_back({std::move(splits), false});
  };
  add(spans.splits(natural));
  for (const double move : kSplitSeries)
    if (move > natural) add(spans.splits(move));
  add({});
  std::size_t most = levels.front().splits.size();
  for (auto move = kSplitSeries.rbegin(); move != kSplitSeries.rend(); ++move) {
    if (!(*move < natural)) continue;
    auto splits = spans.splits(*move);
    if (std::ssize(splits) > kMostSplits) break;
    if (splits.size() <= most) continue;
    most = splits.size();
    levels.push_back({std::move(splits), true});
  }
  return levels;
}

ProfileSpan spanBetween(const std::vector<double>& splits, double at, bool closed) {
  if (splits.empty() || (closed && splits.size() < 2)) return {};
  const auto above = std::upper_bound(splits.begin(), splits.end(), at);
  if (!closed) return {above == splits.begin() ? 0.0 : *(above - 1), above == splits.end() ? 1.0 : *above};
  if (above == splits.begin() || above == splits.end()) return {splits.back(), splits.front() + 1.0};
  return {*(above - 1), *above};
}

}  // namespace batten
