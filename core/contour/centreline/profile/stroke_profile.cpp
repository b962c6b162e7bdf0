// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/profile/stroke_profile.h"

#include <array>

#include "core/contour/centreline/profile/grey_across.h"

namespace batten {
namespace {

constexpr double kLeastStrokeContrast = 2.0;  // [grey] less is noise of the scan
constexpr int kSpreadSamples = 8;             // to which the ink of a stroke spreads beyond its border, 2 px
constexpr double kCrowdedShare = 0.25;        // of the contrast: if the outer end is so much darker, ink lies there
constexpr double kCoreShare = 0.2;            // of the width to either side of the middle, where the ink is full
constexpr double kInkMiddlePx = 1.0;          // to either side of the course: the ink on it
constexpr int kMeansAtOnce = 64;              // boxes: kept on the stack
constexpr double kPaperShare = 0.15;          // of the darkest: what is fainter counts as paper

// Paper across the profile: a line through the level at either side.
struct PaperLine {
  double level = 255.0, slope = 0.0;
  double reach = 0.0;  // samples to either side that belong to this stroke and its paper
  double at(double k) const { return level + slope * k; }
};

// Mean of `count` samples from `first` on.
double meanOfSamples(std::span<const float> p, int first, int count) {
  double sum = 0.0;
  for (int k = first; k < first + count; ++k) sum += p[k];
  return sum / count;
}

// The paper lies at the outer ends, unless another stroke does: then where the grey is brightest on the way there.
PaperLine paperBeside(std::span<const float> p, int edge, double ink) {
  const int n = static_cast<int>(p.size()), half = n / 2;
  const int box = std::min(kPaperSamples, std::max(1, half - edge));
  double level[2], place[2], reach = half;
  // Means of boxes that end so far from the middle, from the outer end in.
  const int boxes = half - edge - box + 1;
  std::array<double, kMeansAtOnce> means;
  for (int side = 0; side < 2; ++side) {
    int best = half;
    double outer = 0.0, brightest = 0.0;
    for (int from = 0; from < boxes; from += kMeansAtOnce) {
      const int count = std::min(kMeansAtOnce, boxes - from);
      // At the left the outermost box is the first, at the right the last.
      const int first = side == 0 ? from : n - box - (from + count - 1);
      meansOfBoxes(p.data() + first, box, count, means.data());
      for (int k = 0; k < count; ++k) {
        const double m = means[side == 0 ? k : count - 1 - k];
        if (from + k == 0) outer = brightest = m;
        if (m > brightest) {
          brightest = m;
          best = half - from - k;
        }
      }
    }
    const bool crowded = brightest - outer > kCrowdedShare * (brightest - ink);
    level[side] = crowded ? brightest : outer;
    const double middle = (crowded ? best : half) - 0.5 * (box - 1);
    place[side] = side == 0 ? half - middle : half + middle;
    if (crowded) reach = std::min(reach, middle);
  }
  PaperLine line;
  line.slope = (level[1] - level[0]) / (place[1] - place[0]);
  line.level = level[0] - line.slope * place[0];
  line.reach = reach;
  return line;
}

}  // namespace

std::optional<StrokeCentre> halfLevelCentre(std::span<const float> profile, double widthPx, std::span<float> scratch) {
  StrokeCentre result;
  const int n = static_cast<int>(profile.size()), half = n / 2;
  smoothAcrossStroke(profile.data(), n, scratch.data());
  const int core = static_cast<int>(std::lround(kCoreShare * widthPx / kStrokeStepPx));
  const int first = std::max(0, half - core);
  const double ink = meanOfSamples(scratch, first, 2 * (half - first) + 1);
  const int edge = std::min(half - 1, static_cast<int>(std::lround(0.5 * widthPx / kStrokeStepPx)));
  const PaperLine paper = paperBeside(scratch, edge, ink);
  const double contrast = paper.at(half) - ink;
  if (!(contrast > kLeastStrokeContrast)) return std::nullopt;
  // Depth below the half level, which follows the slope of the paper.
  const auto depth = [&](int k) { return paper.at(k) - 0.5 * contrast - scratch[k]; };
  if (!(depth(half) > 0.0)) return std::nullopt;
  double border[2] = {0.0, 0.0};
  for (int side = 0; side < 2; ++side) {
    const int d = side == 0 ? -1 : 1;
    int k = half;
    while (k + d >= 0 && k + d < n && depth(k + d) > 0.0) k += d;
    if (k + d < 0 || k + d >= n) return std::nullopt;
    border[side] = (k - half + d * depth(k) / (depth(k) - depth(k + d))) * kStrokeStepPx;
  }
  result.centre = 0.5 * (border[0] + border[1]);
  result.width = border[1] - border[0];
  result.contrast = contrast;
  result.paper = paper.at(half);
  result.slope = paper.slope / kStrokeStepPx;
  result.reach = paper.reach * kStrokeStepPx;
  return result;
}

std::optional<StrokeCentre> centroidCentre(std::span<const float> profile, double reachPx) {
  StrokeCentre result;
  const int n = static_cast<int>(profile.size()), half = n / 2;
  const int reach = std::min(half - 1, static_cast<int>(std::lround(reachPx / kStrokeStepPx)));
  double darkest = 255.0;
  for (int k = half - reach; k <= half + reach; ++k) {
    darkest = std::min<double>(darkest, profile[k]);
  }
  const PaperLine paper = paperBeside(profile, reach, darkest);
  double most = 0.0, sum = 0.0, moment = 0.0, square = 0.0;
  for (int k = half - reach; k <= half + reach; ++k) {
    most = std::max(most, paper.at(k) - profile[k]);
  }
  if (!(most > kLeastStrokeContrast)) return std::nullopt;
  for (int k = half - reach; k <= half + reach; ++k) {
    const double dark = std::max(0.0, paper.at(k) - profile[k] - kPaperShare * most);
    const double u = (k - half) * kStrokeStepPx;
    sum += dark;
    moment += dark * u;
    square += dark * u * u;
  }
  if (!(sum > 0.0)) return std::nullopt;
  const double centre = moment / sum;
  result.centre = centre;
  result.width = std::sqrt(std::max(0.0, 12.0 * (square / sum - centre * centre)));
  result.contrast = most;
  return result;
}

std::vector<float> profileAcross(const GreyImage& grey, const Vec2& at, const Vec2& direction, int half) {
  std::vector<float> mean(2 * half + 1, 0.0f), one(mean.size());
  const Vec2 normal = leftNormal(direction);
  for (int d = -1; d <= 1; ++d) {
    sampleAcross(grey, at + d * direction, normal, half, one.data());
    for (int k = 0; k < std::ssize(mean); ++k) mean[k] += one[k] / 3.0f;
  }
  return mean;
}

InkAcross inkAcross(std::span<const float> profile, double widthPx, double inkLevel) {
  const int half = static_cast<int>(profile.size()) / 2;
  const int edge = std::min(half - 1, static_cast<int>(std::lround(0.5 * widthPx / kStrokeStepPx)));
  const PaperLine paper = paperBeside(profile, edge, inkLevel);
  const int reach = std::min(static_cast<int>(paper.reach), edge + kSpreadSamples);
  InkAcross ink;
  ink.paper = paper.at(half);
  double moment = 0.0;
  for (int k = half - reach; k <= half + reach; ++k) {
    const double dark = paper.at(k) - static_cast<double>(profile[k]);
    ink.darkness += dark * kStrokeStepPx;
    moment += dark * (k - half) * kStrokeStepPx * kStrokeStepPx;
  }
  if (ink.darkness > 0.0) ink.centre = moment / ink.darkness;
  const int near = std::min(half, static_cast<int>(kInkMiddlePx / kStrokeStepPx));
  for (int k = half - near; k <= half + near; ++k)
    ink.middle += (paper.at(k) - static_cast<double>(profile[k])) / (2 * near + 1);
  return ink;
}

}  // namespace batten
