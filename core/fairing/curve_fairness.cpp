// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/curve_fairness.h"

#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"
#include "core/curve/curvature.h"
#include "core/fairing/corner_sections.h"
#include "core/fairing/profile/curvature_samples.h"
#include "core/fairing/profile/profile_data.h"
#include "core/fairing/target/log_aesthetic.h"
#include "core/fairing/target/natural_spans.h"

namespace batten {
namespace {

constexpr int kFairnessSamples = 121;  // at least, along a curve
/// [mm] A tolerance that leaves a closed curve the four extrema that it must have.
constexpr double kFewestExtremaMm = 20.0;
/// Of the largest curvature: a curve whose curvature stays within this is a circle.
constexpr double kEvenCurvature = 1e-6;

/// S of a curve that a log-aesthetic one is looked for.
constexpr double kLeastForLogAesthetic = 0.9;

struct PartFairness {
  double similarity = 1.0;
  std::optional<double> logAesthetic = 1.0;
  std::optional<double> alpha;
  double lengthMm = 0.0;
};

double squaresOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum;
}

/// Squares of the nearest values that only rise or only fall, the better of both: the nearest point of a cone has the
/// greatest S too, and its S is the ratio of the two lengths.
double squaresOfMonotone(std::vector<double> values) {
  const double rising = squaresOf(nearestRising(values));
  for (double& v : values) v = -v;
  return std::max(rising, squaresOf(nearestRising(values)));
}

double monotoneSimilarity(const ProfileData& data, const std::vector<double>& splits, bool closed) {
  const std::vector<double>& values = data.bendsBothWays ? data.kappa : data.radius;
  const double whole = squaresOf(values);
  if (!(whole > 0.0)) return 1.0;
  if (!closed || splits.empty()) return std::sqrt(std::min(1.0, squaresOfMonotone(values) / whole));
  // Around, from one split to the next; the last sample is the first again.
  const int count = static_cast<int>(values.size()) - 1;
  const auto sampleOf = [&](double f) { return std::lround(f * count); };
  double sum = 0.0, all = 0.0;
  for (std::size_t k = 0; k < splits.size(); ++k) {
    const long from = sampleOf(splits[k]);
    const long to = k + 1 < splits.size() ? sampleOf(splits[k + 1]) : sampleOf(splits.front()) + count;
    std::vector<double> part;
    for (long i = from; i < to; ++i) part.push_back(values[i % count]);
    all += squaresOf(part);
    sum += squaresOfMonotone(std::move(part));
  }
  return all > 0.0 ? std::sqrt(std::min(1.0, sum / all)) : 1.0;
}

PartFairness fairnessOfPart(const NurbsCurve& curve, bool closed) {
  PartFairness result;
  const CurvatureSamples samples = sampledCurvature(curve, kFairnessSamples);
  result.lengthMm = samples.lengthMm;
  if (!(samples.lengthMm > 0.0)) return result;
  const double size = extent(curve);
  const auto [low, high] = std::minmax_element(samples.kappa.begin(), samples.kappa.end());
  const double largest = std::max(std::abs(*low), std::abs(*high));
  if (largest * size <= kStraightCurvature || *high - *low <= kEvenCurvature * largest) return result;
  const std::vector<double> splits = closed ? naturalSplits(curve, true, kFewestExtremaMm) : std::vector<double>{};
  const ProfileData data = profileData(samples.perimeters(), samples.kappa, size, TargetQuantity::Curvature);
  result.similarity = monotoneSimilarity(data, splits, closed);
  result.logAesthetic.reset();
  if (result.similarity < kLeastForLogAesthetic) return result;
  const LogAestheticTarget target = logAestheticTarget(curve, closed, splits, std::nullopt, kFairnessSamples);
  if (target.profile.valid) result.logAesthetic = target.profile.similarity;
  if (target.spans.size() == 1 && !closed) result.alpha = target.spans.front().alpha;
  return result;
}

}  // namespace

std::vector<double> nearestRising(const std::vector<double>& values) {
  struct Block {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (const double v : values) {
    blocks.push_back({v, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().count += last.count;
    }
  }
  std::vector<double> result;
  for (const Block& block : blocks) result.insert(result.end(), block.count, block.mean());
  return result;
}

std::optional<CurveFairness> curveFairness(const NurbsCurve& curve, bool closed) {
  if (curve.isEmpty()) return std::nullopt;
  std::vector<PartFairness> parts;
  for (const CornerSection& section : cornerSections(curve, closed)) {
    parts.push_back(fairnessOfPart(section.curve, false));
    if (section.isStraight) parts.back() = PartFairness{1.0, 1.0, {}, parts.back().lengthMm};
  }
  if (parts.empty()) parts.push_back(fairnessOfPart(curve, closed));
  CurveFairness result;
  double length = 0.0, logAesthetic = 0.0;
  bool isAllKnown = true;
  for (const PartFairness& part : parts) {
    length += part.lengthMm;
    result.similarity += part.lengthMm * part.similarity;
    logAesthetic += part.lengthMm * part.logAesthetic.value_or(0.0);
    isAllKnown = isAllKnown && part.logAesthetic;
  }
  if (!(length > 0.0)) return std::nullopt;
  result.similarity /= length;
  if (isAllKnown) result.logAesthetic = logAesthetic / length;
  if (parts.size() == 1) result.alpha = parts.front().alpha;
  result.extrema = countedExtrema(curve, closed);
  result.controlPoints = curve.controlPointCount();
  return result;
}

}  // namespace batten
