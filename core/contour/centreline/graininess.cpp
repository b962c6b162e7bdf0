// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/graininess.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"
#include "core/contour/centreline/stroke_course.h"
#include "core/contour/centreline/stroke_profile.h"
#include "core/image/push_pull.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kWindow = 5;                       // median over 11
constexpr double kMostPx = 60000.0;              // of all stroke paths; longer drawings are sampled more sparsely
constexpr int kFewestSamples = 30;               // of a stroke path, at three px or more: one or two could not tell
constexpr double kPathTellsPx = 90.0;            // a stroke path this long counts as much as its surroundings
constexpr double kRegionTellsPx = 300.0;         // a region with so much line counts as much as the page
constexpr int kLanes = 8;                        // the stroke, then three to either side, and one unused
constexpr double kBeside[3] = {1.5, 2.75, 4.0};  // [px] from the border: one of them misses the next line

constexpr int kEndPoints = 3;                  // at either end, besides the window, where ink fades
constexpr std::size_t kFewestPathPoints = 25;  // a shorter stroke path has too few samples between its ends
constexpr int kLeastStride = 3;                // points: neighbouring samples share pixels
constexpr int kGrainEvery = 8;                 // points: regions are far larger
constexpr double kLeastDepth = 2.0;            // [grey]
constexpr double kMostDeviation = 0.12;        // of the depth: what is farther off is an end, a crossing or a gap
constexpr double kSmallerOfTwo = 1.7;          // mean of |x| over that of the smaller of two, for normal deviates

struct GrainSample {
  Vec2 at = Vec2::Zero();
  double ink = 0.0, paper = 0.0;  // [-] deviations as part of the depth
  double depth = 0.0;             // [grey]
  double px = 0.0;                // of the stroke path that it stands for
};

struct GrainSum {
  double length = 0.0, deviation = 0.0, ink = 0.0, paper = 0.0, depth = 0.0;
  void add(const GrainSample& s) {
    length += s.px;
    deviation += s.px * s.ink;
    ink += s.px * std::min(s.ink, kMostDeviation);
    paper += s.px * std::min(s.paper, kMostDeviation);
    depth += s.px * s.depth;
  }
};

double grainFrom(double ink, double paper) { return std::sqrt(std::max(0.0, ink * ink - paper * paper)); }

using Lanes = std::array<float, kLanes>;

// The median of every lane over 2 kWindow + 1 places: after each round the largest of those left lies behind the
// others. Unrolled, so that all places of a lane lie in registers and the lanes are worked on side by side.
BATTEN_HOT_LOOP void medianOfLanes(const Lanes* places, float* __restrict median) {
  constexpr int kPlaces = 2 * kWindow + 1;
  for (int k = 0; k < kLanes; ++k) {
    float sorted[kPlaces];
    BATTEN_UNROLL
    for (int i = 0; i < kPlaces; ++i) sorted[i] = places[i][k];
    BATTEN_UNROLL
    for (int end = kPlaces - 1; end >= kWindow; --end) {
      BATTEN_UNROLL
      for (int i = 0; i < end; ++i) {
        const float a = sorted[i], b = sorted[i + 1];
        sorted[i] = a < b ? a : b;
        sorted[i + 1] = a < b ? b : a;
      }
    }
    median[k] = sorted[kWindow];
  }
}

// Five taps of a small Gaussian, so that the noise of single pixels counts little.
float softGrey(const GreyImage& grey, const Vec2& at) {
  constexpr float kCentreTap = 0.4f, kSideTap = 0.15f;  // sum 1
  return kCentreTap * sampleGrey(grey, at.x(), at.y()) +
         kSideTap * (sampleGrey(grey, at.x() - 1.0, at.y()) + sampleGrey(grey, at.x() + 1.0, at.y()) +
                     sampleGrey(grey, at.x(), at.y() - 1.0) + sampleGrey(grey, at.x(), at.y() + 1.0));
}

std::vector<GrainSample> samplesAlong(const StrokePath& path, const GreyImage& grey, int most) {
  std::vector<GrainSample> samples;
  if (path.points.size() < kFewestPathPoints) return samples;
  const int stride = std::min(most, std::max(kLeastStride, static_cast<int>(path.points.size()) / kFewestSamples));
  const StrokeCourse course = resample(path);
  const int n = course.count();
  std::vector<Lanes> lanes(n, Lanes{});
  for (int i = 0; i < n; ++i) {
    const CoursePoint& p = course.points[i];
    const Vec2 normal = leftNormal(p.tangent);
    lanes[i][0] = softGrey(grey, p.base);
    for (int k = 0; k < 3; ++k) {
      const double off = 0.5 * course.widthPx + kBeside[k];
      lanes[i][1 + k] = softGrey(grey, p.base + off * normal);
      lanes[i][4 + k] = softGrey(grey, p.base - off * normal);
    }
  }
  for (int i = kWindow + kEndPoints; i + kWindow + kEndPoints < n; i += stride) {
    if (course.points[i].part != StrokePart::Ink) continue;
    Lanes median;
    medianOfLanes(lanes.data() + (i - kWindow), median.data());
    // Beside the stroke the brightest lane is paper; others may lie on the next line.
    const auto left = std::max_element(median.begin() + 1, median.begin() + 4) - median.begin();
    const auto right = std::max_element(median.begin() + 4, median.begin() + 7) - median.begin();
    const double depth = std::max(median[left], median[right]) - median[0];
    if (!(depth > kLeastDepth)) continue;
    const auto off = [&](std::ptrdiff_t k) { return static_cast<double>(std::abs(lanes[i][k] - median[k])); };
    samples.push_back({course.points[i].base, off(0) / depth, kSmallerOfTwo * std::min(off(left), off(right)) / depth,
                       depth, static_cast<double>(stride)});
  }
  return samples;
}

// Values of the regions; those with little line lean on their neighbours.
RegionValues filledRegions(const std::array<GrainSum, kRegions>& sums, double GrainSum::*what) {
  std::vector<float> values(kRegions, 0.0f), weights(kRegions, 0.0f);
  for (int r = 0; r < kRegions; ++r) {
    if (!(sums[r].length > 0.0)) continue;
    values[r] = static_cast<float>(sums[r].*what / sums[r].length);
    weights[r] = static_cast<float>(sums[r].length / (sums[r].length + kRegionTellsPx));
  }
  const std::vector<float> filled = pushPull(values, weights, kRegionsPerSide, kRegionsPerSide);
  RegionValues result{};
  std::copy(filled.begin(), filled.end(), result.begin());
  return result;
}

// Bilinear between the centres of the regions.
double valueAt(const RegionValues& values, const Vec2& px, int width, int height) {
  const double most = kRegionsPerSide - 1.0;
  const double u = std::clamp(px.x() * kRegionsPerSide / width - 0.5, 0.0, most);
  const double v = std::clamp(px.y() * kRegionsPerSide / height - 0.5, 0.0, most);
  const int x = std::min(static_cast<int>(u), kRegionsPerSide - 2),
            y = std::min(static_cast<int>(v), kRegionsPerSide - 2);
  const auto at = [&](int dx, int dy) { return values[(y + dy) * kRegionsPerSide + x + dx]; };
  return std::lerp(std::lerp(at(0, 0), at(1, 0), u - x), std::lerp(at(0, 1), at(1, 1), u - x), v - y);
}

}  // namespace

GraininessMap::GraininessMap(const std::vector<StrokePath>& paths, const GreyImage& grey, const RunContext& context)
    : grains_(paths.size(), 0.0), width_(std::max(1, grey.width)), height_(std::max(1, grey.height)) {
  double total = 0.0;
  for (const StrokePath& s : paths) total += static_cast<double>(s.points.size());
  const int stride = static_cast<int>(kLeastStride * std::max(1.0, total / kMostPx));
  std::vector<std::vector<GrainSample>> samples(paths.size());
  parallelFor(context, static_cast<int>(paths.size()), 4, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      samples[i] = samplesAlong(paths[i], grey, stride);
    }
  });
  std::array<GrainSum, kRegions> regions{};
  std::vector<GrainSum> own(paths.size());
  for (int i = 0; i < std::ssize(paths); ++i) {
    for (const GrainSample& s : samples[i]) {
      const int x = std::clamp(static_cast<int>(s.at.x()), 0, width_ - 1);
      const int y = std::clamp(static_cast<int>(s.at.y()), 0, height_ - 1);
      regions[regionOf(x, y, width_, height_)].add(s);
      own[i].add(s);
    }
  }
  deviation_ = filledRegions(regions, &GrainSum::deviation);
  ink_ = filledRegions(regions, &GrainSum::ink);
  paper_ = filledRegions(regions, &GrainSum::paper);
  depth_ = filledRegions(regions, &GrainSum::depth);
  for (int i = 0; i < std::ssize(paths); ++i) {
    const std::vector<StrokePathPoint>& points = paths[i].points;
    if (points.empty()) continue;
    double ink = 0.0, paper = 0.0, count = 0.0;
    for (int k = 0; k < std::ssize(points); k += kGrainEvery, count += 1.0) {
      ink += valueAt(ink_, points[k].at, width_, height_);
      paper += valueAt(paper_, points[k].at, width_, height_);
    }
    const double weight = own[i].length + kPathTellsPx;
    grains_[i] = grainFrom((own[i].ink + kPathTellsPx * ink / count) / weight,
                           (own[i].paper + kPathTellsPx * paper / count) / weight);
  }
}

double GraininessMap::deviationAt(const Vec2& px) const { return valueAt(deviation_, px, width_, height_); }

double GraininessMap::depthAt(const Vec2& px) const { return valueAt(depth_, px, width_, height_); }

}  // namespace batten
