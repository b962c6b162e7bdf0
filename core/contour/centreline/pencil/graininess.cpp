// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/graininess.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/hot_loop.h"
#include "core/base/interpolation.h"
#include "core/base/parallel.h"
#include "core/contour/centreline/page_scale.h"
#include "core/contour/centreline/profile/stroke_course.h"
#include "core/contour/centreline/profile/stroke_profile.h"
#include "core/image/fine_page.h"
#include "core/image/push_pull.h"
#include "core/solve/small_least_squares.h"

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
constexpr int kPathsPerBlock = 4;              // worked on together; the result does not depend on it
constexpr int kDepthPlaces = 12;               // along a stroke path without samples
constexpr double kPenDepths = 2.0;             // of the pencil's depth: a stroke so dark may be a pen's
constexpr double kPenGrain = 0.75;             // of the pencil's grain: that of a pen beside it is less
constexpr double kLeastTold = 0.1;             // of all strokes: of letters alone too little is plain to tell
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

using RegionSums = std::array<GrainSum, kRegions>;

double grainFrom(double ink, double paper) { return std::sqrt(std::max(0.0, ink * ink - paper * paper)); }

using Lanes = std::array<float, kLanes>;

// The median of every lane over 2 kWindow + 1 places: after each round the largest of those left lies behind the
// others. Unrolled, so that all places of a lane lie in registers and the lanes are worked on side by side.
BATTEN_HOT_LOOP void medianOfLanes(const Lanes* places, float* __restrict median) {
  constexpr int kPlaces = 2 * kWindow + 1;  // the middle one, and those to both sides
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
  constexpr double kReachPx = 2.0;                      // of the taps and the pixels around them
  constexpr float kCentreTap = 0.4f, kSideTap = 0.15f;  // sum 1
  const auto soft = [&](const auto& sample) {
    return kCentreTap * sample(grey, at.x(), at.y()) +
           kSideTap * (sample(grey, at.x() - 1.0, at.y()) + sample(grey, at.x() + 1.0, at.y()) +
                       sample(grey, at.x(), at.y() - 1.0) + sample(grey, at.x(), at.y() + 1.0));
  };
  const bool isInside =
      at.x() > kReachPx && at.y() > kReachPx && at.x() < grey.width - kReachPx && at.y() < grey.height - kReachPx;
  return isInside ? soft(sampleGreyInside) : soft(sampleGrey);
}

// Whether the stroke runs alone and nearly straight so far to both sides of a place that its greys tell of its grain.
bool isPlain(const StrokeCourse& course, int i) {
  constexpr double kMostTurn = 0.7;  // cosine of the angle, from one end of the window to the other
  for (int k = i - kWindow; k <= i + kWindow; ++k)
    if (course.points[k].part != StrokePart::Ink) return false;
  return course.points[i - kWindow].tangent.dot(course.points[i + kWindow].tangent) >= kMostTurn;
}

// What differs from the medians at some places of a stroke.
struct Deviation {
  Vec2 at = Vec2::Zero();
  Lanes off{};
  double depth = 0.0;
  std::ptrdiff_t left = 0, right = 0;  // lanes of paper
};

// Between pixels grey is a mean of those around, which is not that of a sharp line a pixel or two wide: it changes with
// the place within a pixel, and so does that of lines side by side. What repeats from pixel to pixel is no grain: a
// mean and the first waves along the rows, the columns and both diagonals.
constexpr int kPixelTerms = 9;
constexpr std::ptrdiff_t kFewestOfPixels = 3 * kPixelTerms;  // samples: fewer are explained by any terms
using PixelTerms = Eigen::Matrix<double, kPixelTerms, 1>;
PixelTerms pixelTermsAt(const Vec2& at) {
  const double x = 2.0 * std::numbers::pi * at.x(), y = 2.0 * std::numbers::pi * at.y();
  return (PixelTerms() << 1.0, std::cos(x), std::sin(x), std::cos(y), std::sin(y), std::cos(x + y), std::sin(x + y),
          std::cos(x - y), std::sin(x - y))
      .finished();
}

void removeOfPixels(std::vector<Deviation>& deviations) {
  constexpr double kMostLeft = 0.25;  // of the squares: of grain the terms explain about what they are of the samples
  constexpr double kPrior = 1e-3;     // per sample: terms that are one along a diagonal, share what they explain
  const std::ptrdiff_t count = std::ssize(deviations);
  if (count < kFewestOfPixels) return;
  SmallLeastSquares<kPixelTerms, kLanes> fit;
  for (const Deviation& d : deviations)
    fit.add(pixelTermsAt(d.at), Eigen::Map<const Eigen::Matrix<float, 1, kLanes>>(d.off.data()).cast<double>());
  fit.hold(PixelTerms::Constant(kPrior * static_cast<double>(count)));
  const Eigen::Matrix<double, kPixelTerms, kLanes> waves = fit.solve();
  std::vector<Lanes> rest;
  double all = 0.0, left = 0.0;
  for (const Deviation& d : deviations) {
    const Eigen::Matrix<double, 1, kLanes> repeats = pixelTermsAt(d.at).transpose() * waves;
    Lanes& of = rest.emplace_back();
    for (int k = 0; k < kLanes; ++k) of[k] = d.off[k] - static_cast<float>(repeats[k]);
    all += static_cast<double>(d.off[0] * d.off[0]);
    left += static_cast<double>(of[0] * of[0]);
  }
  if (left > kMostLeft * all) return;
  for (std::ptrdiff_t i = 0; i < count; ++i) deviations[i].off = rest[i];
}

std::vector<GrainSample> samplesAlong(const StrokePath& path, const GreyImage& grey, int most, GrainPlaces places) {
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
  std::vector<Deviation> deviations;
  for (int i = kWindow + kEndPoints; i + kWindow + kEndPoints < n; i += stride) {
    if (places == GrainPlaces::Plain ? !isPlain(course, i) : course.points[i].part != StrokePart::Ink) continue;
    Lanes median;
    medianOfLanes(lanes.data() + (i - kWindow), median.data());
    // Beside the stroke the brightest lane is paper; others may lie on the next line.
    Deviation d{course.points[i].base, {}, 0.0, 0, 0};
    d.left = std::max_element(median.begin() + 1, median.begin() + 4) - median.begin();
    d.right = std::max_element(median.begin() + 4, median.begin() + 7) - median.begin();
    d.depth = static_cast<double>(std::max(median[d.left], median[d.right]) - median[0]);
    if (!(d.depth > kLeastDepth)) continue;
    for (int k = 0; k < kLanes; ++k) d.off[k] = lanes[i][k] - median[k];
    deviations.push_back(d);
  }
  if (places == GrainPlaces::Plain) removeOfPixels(deviations);
  for (const Deviation& d : deviations) {
    const auto off = [&](std::ptrdiff_t k) { return static_cast<double>(std::abs(d.off[k])); };
    samples.push_back({d.at, off(0) / d.depth, kSmallerOfTwo * std::min(off(d.left), off(d.right)) / d.depth, d.depth,
                       static_cast<double>(stride)});
  }
  return samples;
}

// How much of all strokes the samples stand for.
double toldShare(const std::vector<std::vector<GrainSample>>& samples, double totalPx) {
  double px = 0.0;
  for (const std::vector<GrainSample>& ofPath : samples)
    for (const GrainSample& s : ofPath) px += s.px;
  return totalPx > 0.0 ? px / totalPx : 0.0;
}

// [grey] How much darker a stroke path is than the paper beside it: by its samples, or where it is too short for any,
// at a few places along it.
double depthOf(const StrokePath& path, const std::vector<GrainSample>& samples, const GreyImage& grey) {
  if (!samples.empty()) {
    double sum = 0.0;
    for (const GrainSample& s : samples) sum += s.depth;
    return sum / static_cast<double>(samples.size());
  }
  if (path.points.size() < 2) return 0.0;
  const StrokeCourse course = resample(path);
  const int n = course.count(), step = std::max(1, n / kDepthPlaces);
  double sum = 0.0;
  int count = 0;
  for (int i = step / 2; i < n; i += step, ++count) {
    const CoursePoint& p = course.points[i];
    float left = 0.0f, right = 0.0f;
    for (const double beside : kBeside) {
      const Vec2 away = (0.5 * course.widthPx + beside) * leftNormal(p.tangent);
      left = std::max(left, softGrey(grey, p.base + away));
      right = std::max(right, softGrey(grey, p.base - away));
    }
    sum += static_cast<double>(std::max(left, right) - softGrey(grey, p.base));
  }
  return count > 0 ? sum / count : 0.0;
}

// What is known of one stroke path.
struct PathGrain {
  GrainSum own;
  double depth = 0.0;  // [grey]
  double grain = 0.0;  // [-]
};

// [grey] The depth beyond which strokes are a pen's where a pen was used beside a pencil: long strokes, which tell by
// themselves, are much darker than the pencil's and less grainy. Absent: the page shows no such strokes.
std::optional<double> leastPenDepth(const std::vector<PathGrain>& paths) {
  const auto tells = [](const PathGrain& p) { return p.own.length >= kPathTellsPx; };
  std::vector<std::pair<double, double>> pencil;  // depth, length
  double all = 0.0, grain = 0.0;
  for (const PathGrain& p : paths) {
    if (!tells(p) || p.grain <= kPencilGrain) continue;
    pencil.emplace_back(p.depth, p.own.length);
    all += p.own.length;
    grain += p.own.length * p.grain;
  }
  if (pencil.empty()) return std::nullopt;
  std::sort(pencil.begin(), pencil.end());
  double sum = 0.0, limit = 0.0;
  for (const auto& [depth, length] : pencil) {
    sum += length;
    limit = kPenDepths * depth;
    if (2.0 * sum >= all) break;
  }
  double pens = 0.0, penGrain = 0.0;
  for (const PathGrain& p : paths) {
    if (!tells(p) || p.depth <= limit) continue;
    pens += p.own.length;
    penGrain += p.own.length * p.grain;
  }
  if (pens < kRegionTellsPx || penGrain / pens > kPenGrain * grain / all) return std::nullopt;
  return limit;
}

// Values of the regions; those with little line lean on their neighbours.
RegionValues filledRegions(const RegionSums& sums, double GrainSum::*what) {
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
  const BilinearPlace place(kRegionsPerSide, kRegionsPerSide, px.x() * kRegionsPerSide / width - 0.5,
                            px.y() * kRegionsPerSide / height - 0.5);
  return place.of([&](int x, int y) { return values[y * kRegionsPerSide + x]; });
}

}  // namespace

GraininessMap::GraininessMap(const std::vector<StrokePath>& paths, const GreyImage& grey, const RunContext& context,
                             GrainPlaces places)
    : grains_(paths.size(), 0.0), width_(std::max(1, grey.width)), height_(std::max(1, grey.height)) {
  double total = 0.0;
  for (const StrokePath& s : paths) total += static_cast<double>(s.points.size());
  const int stride = static_cast<int>(kLeastStride * std::max(1.0, total / kMostPx));
  std::vector<std::vector<GrainSample>> samples(paths.size());
  std::vector<double> depths(paths.size(), 0.0);
  parallelFor(context, static_cast<int>(paths.size()), kPathsPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      samples[i] = samplesAlong(paths[i], grey, stride, places);
      depths[i] = depthOf(paths[i], samples[i], grey);
    }
  });
  if (places == GrainPlaces::Plain && toldShare(samples, total) < kLeastTold) return;
  const auto regionAt = [&](const Vec2& at) {
    return regionOf(std::clamp(static_cast<int>(at.x()), 0, width_ - 1),
                    std::clamp(static_cast<int>(at.y()), 0, height_ - 1), width_, height_);
  };
  std::vector<PathGrain> known(paths.size());
  RegionSums regions{};
  for (int i = 0; i < std::ssize(paths); ++i) {
    known[i].depth = depths[i];
    for (const GrainSample& s : samples[i]) {
      regions[regionAt(s.at)].add(s);
      known[i].own.add(s);
    }
  }
  const RegionValues ink = filledRegions(regions, &GrainSum::ink), paper = filledRegions(regions, &GrainSum::paper);
  for (int i = 0; i < std::ssize(paths); ++i) {
    const std::vector<StrokePathPoint>& points = paths[i].points;
    if (points.empty()) continue;
    double inkSum = 0.0, paperSum = 0.0, count = 0.0;
    for (int k = 0; k < std::ssize(points); k += kGrainEvery, count += 1.0) {
      inkSum += valueAt(ink, points[k].at, width_, height_);
      paperSum += valueAt(paper, points[k].at, width_, height_);
    }
    const GrainSum& own = known[i].own;
    const double weight = own.length + kPathTellsPx;
    known[i].grain = grainFrom((own.ink + kPathTellsPx * inkSum / count) / weight,
                               (own.paper + kPathTellsPx * paperSum / count) / weight);
  }
  const std::optional<double> penDepth = leastPenDepth(known);
  const auto isDark = [&](int path) { return penDepth && known[path].depth > *penDepth; };
  for (int i = 0; i < std::ssize(paths); ++i) {
    const bool isPen = isDark(i) && known[i].own.length < kRegionTellsPx;
    grains_[i] = isPen ? std::min(known[i].grain, kPencilGrain) : known[i].grain;
  }
  if (penDepth) regions = {};
  for (int i = 0; i < std::ssize(paths) && penDepth; ++i) {
    if (isDark(i)) continue;
    for (const GrainSample& s : samples[i]) regions[regionAt(s.at)].add(s);
  }
  deviation_ = filledRegions(regions, &GrainSum::deviation);
  depth_ = filledRegions(regions, &GrainSum::depth);
}

GraininessMap grainOnFinePage(const std::vector<StrokePath>& paths, const GreyImage& page, const RunContext& context) {
  GraininessMap map(fromFinePage(paths), page, context, GrainPlaces::Plain);
  map.width_ *= kFineFactor;
  map.height_ *= kFineFactor;
  return map;
}

double GraininessMap::deviationAt(const Vec2& px) const { return valueAt(deviation_, px, width_, height_); }

double GraininessMap::depthAt(const Vec2& px) const { return valueAt(depth_, px, width_, height_); }

}  // namespace batten
