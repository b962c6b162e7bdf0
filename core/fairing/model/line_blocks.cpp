// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/model/line_blocks.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/fairing/model/fairing_line.h"

namespace batten {
namespace {

/// Blocks of so many pixels, as in the fair fit; short lines have shorter ones of a few points each.
constexpr double kBlockPx = 8.0;
constexpr double kFewestBlocks = 40.0;   // of a line
constexpr double kPointsPerBlock = 3.0;  // at least
/// Points that lie off by more than so many standard deviations belong to something else.
constexpr double kOutlier = 6.0;
/// [px] The noise of points on a perfect page, below which none counts as an outlier (kLeastNoisePx of the fair fit).
constexpr double kNoiseFloorPx = 0.02;
/// Of the extent: a point whose foot lies farther along the curve than this is beyond its end.
constexpr double kBeyondEnd = 1e-3;
/// A block with less than this share of its points is none.
constexpr double kLeastShare = 0.3;

struct Foot {
  double sample = 0.0, distance = 0.0;
};

/// Feet of the points on the sketched curve. Those beyond its ends are left out.
std::vector<Foot> feetOf(const FairingSetup& setup, const std::vector<Vec2>& points) {
  std::vector<Vec2> samples;
  for (const SpanPlace& place : setup.start.places) samples.push_back(setup.reference.at(place, 0)[0]);
  const int count = setup.sampleCount();
  std::vector<Foot> feet;
  int hint = 0;
  for (const Vec2& p : points) {
    if (setup.check.isCancelled()) return feet;
    if (!p.allFinite()) continue;
    const auto better = [&](int i, int j) { return (samples[i] - p).squaredNorm() < (samples[j] - p).squaredNorm(); };
    // Near where the last point was; anywhere, when that leads to the end of the stretch that was searched.
    constexpr int kNear = 6;
    const int low = std::max(0, hint - kNear), high = std::min(count - 1, hint + kNear);
    int best = hint;
    for (int i = low; i <= high; ++i) best = better(i, best) ? i : best;
    const bool atBorder = feet.empty() || (best == low && low > 0) || (best == high && high + 1 < count);
    for (int i = 0; atBorder && i < count; ++i) best = better(i, best) ? i : best;
    hint = best;
    const SpanPlace place = footPoint(setup.reference, p, setup.start.places[best]);
    const Jet jet = setup.reference.at(place, 1);
    if (!(jet[1].norm() > 0.0)) continue;
    const Vec2 tangent = jet[1].normalized(), away = p - jet[0];
    if (std::abs(away.dot(tangent)) > kBeyondEnd * setup.extent) continue;
    feet.push_back({setup.sampleAt(place), away.dot(leftNormal(tangent))});
  }
  return feet;
}

void dropOutliers(std::vector<Foot>& feet, double pixelMm) {
  std::vector<double> sizes;
  sizes.reserve(feet.size());
  for (const Foot& f : feet) sizes.push_back(std::abs(f.distance));
  if (sizes.empty()) return;
  const double most = kOutlier * std::max(robustSigma(sizes), kNoiseFloorPx * pixelMm);
  std::erase_if(feet, [&](const Foot& f) { return std::abs(f.distance) > most; });
}

}  // namespace

LineBlocks lineBlocks(const FairingSetup& setup, const FairingLine& line) {
  LineBlocks result;
  std::vector<Foot> feet = feetOf(setup, line.points);
  dropOutliers(feet, line.pixelMm);
  const double length = setup.start.length, points = static_cast<double>(feet.size());
  const double byPixels = line.pixelMm > 0.0 ? length / (kBlockPx * line.pixelMm) : points / kBlockPx;
  const double wanted = std::max(byPixels, kFewestBlocks);
  const int count = static_cast<int>(std::min(wanted, points / kPointsPerBlock));
  if (count < 1) return result;
  result.widthMm = length / count;
  const double samples = setup.closed ? setup.sampleCount() : setup.sampleCount() - 1;
  struct Sum {
    double sample = 0.0, distance = 0.0, count = 0.0;
  };
  std::vector<Sum> sums(count);
  for (const Foot& f : feet) {
    Sum& sum = sums[std::clamp(static_cast<int>(f.sample / samples * count), 0, count - 1)];
    sum.sample += f.sample;
    sum.distance += f.distance;
    sum.count += 1.0;
  }
  for (const Sum& sum : sums) {
    if (sum.count < std::max(1.0, kLeastShare * points / count)) continue;
    result.blocks.push_back({sum.sample / sum.count, sum.distance / sum.count});
  }
  return result;
}

std::vector<double> LineBlocks::offsets(const FairingSetup& setup) const {
  std::vector<double> result(setup.sampleCount(), 0.0);
  if (blocks.empty()) return result;
  std::size_t next = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double x = static_cast<double>(i);
    while (next < blocks.size() && blocks[next].sample <= x) ++next;
    Block before = next > 0 ? blocks[next - 1] : blocks.back();
    Block after = next < blocks.size() ? blocks[next] : blocks.front();
    // The ends of an open curve stay where they are, whatever the points say.
    if (!setup.closed && next == 0) before = {0.0, 0.0};
    if (!setup.closed && next == blocks.size()) after = {setup.sampleCount() - 1.0, 0.0};
    if (setup.closed && next == 0) before.sample -= setup.sampleCount();
    if (setup.closed && next == blocks.size()) after.sample += setup.sampleCount();
    const double gap = after.sample - before.sample;
    const double share = gap > 0.0 ? (x - before.sample) / gap : 0.5;
    result[i] = before.distance + share * (after.distance - before.distance);
  }
  return result;
}

double LineBlocks::misfit(const FairingSetup& setup, const FairingState& state) const {
  const auto& samples = state.samples;
  std::vector<double> at;
  at.reserve(samples.size());
  for (const FairingSample& sample : samples) at.push_back(setup.sampleAt(sample.foot));
  double sum = 0.0;
  std::size_t next = 1;
  for (const Block& block : blocks) {
    while (next + 1 < at.size() && at[next] < block.sample) ++next;
    const double gap = at[next] - at[next - 1];
    const double share = gap > 0.0 ? std::clamp((block.sample - at[next - 1]) / gap, 0.0, 1.0) : 0.5;
    const double before = samples[next - 1].distance, after = samples[next].distance;
    const double distance = before + share * (after - before);
    sum += (distance - block.distance) * (distance - block.distance);
  }
  return sum;
}

}  // namespace batten
