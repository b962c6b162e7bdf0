// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/placing/pixel_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/centreline/placing/border_sums.h"
#include "core/contour/subpixel/blur_search.h"
#include "core/contour/subpixel/curvature_shift.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kToneSigma = 6.0;         // points: ink and paper change slowly along a stroke
constexpr double kFarthestPx = 0.3;        // from the half levels
constexpr double kSmallestContrast = 4.0;  // [grey]
constexpr double kProfileVariance = 0.42;  // [px^2] of the smoothing that a profile's middle has seen: .5 px, bilinear
constexpr int kBlurPoints = 400;           // that vote for the blur
constexpr int kBlurEvery = 5;              // points: neighbours share their pixels
constexpr int kStartBlur = 12;             // index of .65 px, the usual blur of a scanner
constexpr std::array kBlurStrides = {6, 2, 1};              // of the search from there
constexpr int kGainPoints = 60;                             // of a stroke that vote for its darkness
constexpr double kLargestGainChange = 1.25;                 // in one go: the darkness that profiles show is off by less
constexpr int kPointsPerBlock = 64;                         // worked on together; the result does not depend on it
constexpr int kStrokeNewtonSteps = 4;                       // from the half levels; fewer once settled
constexpr double kLargestStepPx = 0.25, kSettledPx = 2e-3;  // of one step; smaller ones change nothing
constexpr double kLeastDeterminant = 1e-3;  // of the product of its diagonal: the two borders cannot be told apart
constexpr double kNarrowestPx = 0.2;        // a stroke between borders nearer than this is none
constexpr double kWidthOffShare = 0.3, kWidthOffPx = 0.3;  // from the width along the stroke: another stroke
constexpr double kCoreWidths = 0.2;     // [stroke widths] about the middle, where profiles measure the darkness
constexpr double kLeastCorePart = 0.2;  // of the darkness that is left there: thinner strokes say too little

struct Stroke {
  double middle = 0.0, width = 1.0;  // [px]
};

struct StrokeModel {
  double paper, slope, contrast;
  ResponseRow response;
};

/// How pixels see the borders of strokes, and how the middle of a profile does, which has seen more blur.
struct PageResponse {
  const PixelResponse& pixels;
  const PixelResponse& profile;

  explicit PageResponse(int index)
      : pixels(PixelResponse::forBlur(index)),
        profile(PixelResponse::forBlur(blurIndex(std::sqrt(pixels.blur() * pixels.blur() + kProfileVariance)))) {}
};

/// The darkness of a stroke without blur: the profile's middle has lost some of it to the paper.
double fullContrast(double measured, double width, const ResponseRow& wide) {
  double part = 0.0;
  for (const double u : {-kCoreWidths * width, 0.0, kCoreWidths * width})
    part += (wide.at(u + 0.5 * width).part - wide.at(u - 0.5 * width).part) / 3.0;
  return measured / std::max(kLeastCorePart, part);
}

double inkPart(const StrokeModel& m, const Stroke& s, double distance) {
  const double u = distance - s.middle;
  return m.response.at(u + 0.5 * s.width).part - m.response.at(u - 0.5 * s.width).part;
}

double squaresLeft(const PixelWindow& window, const StrokeModel& m, const Stroke& s) {
  double sum = 0.0;
  for (int i = 0; i < window.count(); ++i) {
    const double distance = window.distance()[i];
    const double e = window.grey()[i] - (m.paper + m.slope * distance - m.contrast * inkPart(m, s, distance));
    sum += window.weight()[i] * e * e;
  }
  return sum;
}

/// What the sums tell of the middle: weighted least squares under white noise.
PointInformation informationOf(const BorderSums& s, const SquareSums& w) {
  const double a = (s.hh - s.lh) / s.det(), b = (s.ll - s.lh) / s.det();  // (1 1) times the inverse
  const double gain = 0.5 * std::sqrt(std::max(0.0, a * a * w.ll + 2.0 * a * b * w.lh + b * b * w.hh));
  const double taken = (s.hh * s.l * s.l - 2.0 * s.lh * s.l * s.h + s.ll * s.h * s.h) / s.det();
  const double used = (s.hh * w.ll - 2.0 * s.lh * w.lh + s.ll * w.hh) / s.det();
  return {gain, std::max(0.0, w.squares - taken), std::max(0.0, w.weights - used)};
}

/// The pixels about a point, and what the model leaves of them.
struct PointPixels {
  PixelWindow window;
  std::vector<double> left, byLow, byHigh;
};

/// A stroke, and how well the pixels tell where its middle lies.
struct PlacedStroke {
  Stroke stroke;
  PointInformation information;
};

/// Newton steps for both borders.
std::optional<PlacedStroke> mostLikely(PointPixels& at, const StrokeModel& m, double width) {
  const int count = at.window.fullCount();
  for (std::vector<double>* values : {&at.left, &at.byLow, &at.byHigh}) {
    if (std::ssize(*values) < count) values->resize(count);
  }
  const StrokePixels pixels{at.window.distance(), at.window.weight(), at.window.grey(), count};
  const BorderResiduals residuals{at.left.data(), at.byLow.data(), at.byHigh.data()};
  StrokeBorders borders{m.response, m.paper, m.slope, m.contrast, -0.5 * width, 0.5 * width};
  BorderSums sums;
  for (int step = 0; step < kStrokeNewtonSteps; ++step) {
    sums = borderKernels().sums(pixels, borders, residuals);
    const double det = sums.det();
    if (!(det > kLeastDeterminant * sums.ll * sums.hh)) return std::nullopt;
    const double moveLow = std::clamp((sums.hh * sums.l - sums.lh * sums.h) / det, -kLargestStepPx, kLargestStepPx);
    const double moveHigh = std::clamp((sums.ll * sums.h - sums.lh * sums.l) / det, -kLargestStepPx, kLargestStepPx);
    borders.low += moveLow;
    borders.high += moveHigh;
    if (!(borders.high - borders.low > kNarrowestPx)) return std::nullopt;
    if (std::abs(moveLow) + std::abs(moveHigh) < kSettledPx) break;
  }
  return PlacedStroke{{0.5 * (borders.low + borders.high), borders.high - borders.low},
                      informationOf(sums, borderKernels().squares(pixels, residuals))};
}

/// Tone and width at a point as they are along the stroke, without the noise of single profiles.
struct SmoothTone {
  float contrast = 0.0f, paper = 0.0f, slope = 0.0f, width = 0.0f;
};

std::vector<SmoothTone> smoothTones(const StrokeCourse& c) {
  std::vector<float> weight(c.count());
  std::vector<SmoothTone> tones(c.count());
  for (int i = 0; i < c.count(); ++i) {
    const CoursePoint& p = c.points[i];
    if (!p.measured || !p.tone) continue;
    weight[i] = 1.0f;
    tones[i] = {p.tone->contrast, p.tone->paper, p.tone->slope, p.measuredWidth};
  }
  const std::vector<float> sum = smoothValues(weight, c.closed, kToneSigma);
  for (float SmoothTone::*value : {&SmoothTone::contrast, &SmoothTone::paper, &SmoothTone::slope, &SmoothTone::width}) {
    std::vector<float> mean;
    mean.reserve(tones.size());
    for (const SmoothTone& t : tones) mean.push_back(t.*value);
    mean = smoothValues(mean, c.closed, kToneSigma);
    for (int i = 0; i < c.count(); ++i) tones[i].*value = sum[i] > 0.0f ? mean[i] / sum[i] : 0.0f;
  }
  return tones;
}

class Placer {
 public:
  Placer(const StrokeCourse& course, const GreyImage& grey) : c_(course), grey_(grey), tones_(smoothTones(course)) {}

  bool canPlace(int i) const {
    const CoursePoint& p = c_.points[i];
    return p.measured && p.tone && p.part == StrokePart::Ink && tones_[i].contrast > kSmallestContrast;
  }
  /// Measures by how much the darkness that profiles show differs from that of the pixels' own model.
  void tune(const PageResponse& response, PointPixels& pixels) {
    const int stride = std::max(1, c_.count() / kGainPoints);
    double top = 0.0, bottom = 0.0;
    for (int i = 0; i < c_.count(); i += stride) {
      if (!canPlace(i)) continue;
      const auto placed = place(i, response, pixels);
      if (!placed) continue;
      const StrokeModel m = modelAt(i, response);
      const PixelWindow& window = pixels.window;
      for (int k = 0; k < window.count(); ++k) {
        const double distance = window.distance()[k], weight = window.weight()[k];
        const double model = m.contrast * inkPart(m, placed->stroke, distance);
        top += weight * model * (m.paper + m.slope * distance - window.grey()[k]);
        bottom += weight * model * model;
      }
    }
    if (bottom > 0.0) gain_ *= std::clamp(top / bottom, 1.0 / kLargestGainChange, kLargestGainChange);
  }
  /// The stroke at point i. `pixels` then holds those that it was found from.
  std::optional<PlacedStroke> place(int i, const PageResponse& response, PointPixels& pixels) const {
    const CoursePoint& p = c_.points[i];
    const double width = tones_[i].width;
    const double reach =
        std::min(0.5 * width + response.pixels.reach() + kFarthestPx, static_cast<double>(p.tone->reach));
    pixels.window.read(grey_, p.base, leftNormal(p.tangent), -reach, reach);
    const auto placed = mostLikely(pixels, modelAt(i, response), width);
    if (!placed || std::abs(placed->stroke.middle) > kFarthestPx ||
        std::abs(placed->stroke.width - width) > kWidthOffShare * width + kWidthOffPx)
      return std::nullopt;
    return placed;
  }
  /// [grey^2] What the model leaves of the pixels at point i; nothing where it does not describe them.
  std::optional<double> squaresAt(int i, const PageResponse& response, PointPixels& pixels) const {
    const auto placed = place(i, response, pixels);
    if (!placed) return std::nullopt;
    return squaresLeft(pixels.window, modelAt(i, response), placed->stroke);
  }

 private:
  StrokeModel modelAt(int i, const PageResponse& response) const {
    const SmoothTone& tone = tones_[i];
    const int direction = response.pixels.direction(leftNormal(c_.points[i].tangent));
    const double contrast = gain_ * fullContrast(tone.contrast, tone.width, response.profile.row(direction));
    return {tone.paper, tone.slope, contrast, response.pixels.row(direction)};
  }

  const StrokeCourse& c_;
  const GreyImage& grey_;
  std::vector<SmoothTone> tones_;
  double gain_ = 1.0;
};

/// A point of one of the courses.
struct CoursePlace {
  int course, point;
};

/// Up to about `kBlurPoints` of the points that can be placed, from all over the page.
std::vector<CoursePlace> sampleOf(const std::vector<StrokeCourse>& courses, const std::vector<Placer>& placers) {
  std::vector<CoursePlace> all, some;
  for (int c = 0; c < std::ssize(courses); ++c)
    for (int i = 0; i < courses[c].count(); i += kBlurEvery)
      if (placers[c].canPlace(i)) all.push_back({c, i});
  const int stride = std::max(1, static_cast<int>(all.size()) / kBlurPoints);
  for (int k = 0; k < std::ssize(all); k += stride) some.push_back(all[k]);
  return some;
}

/// Makes the tables that every page needs, side by side: later ones wait for each other.
void makeTables(std::initializer_list<int> indices, const RunContext& context) {
  parallelFor(context, static_cast<int>(indices.size()), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) (void)PageResponse(*(indices.begin() + k));
  });
}

/// Index of the blur that leaves least of the pixels' grey unexplained.
int pageBlur(const std::vector<StrokeCourse>& courses, const std::vector<Placer>& placers, const RunContext& context) {
  const std::vector<CoursePlace> some = sampleOf(courses, placers);
  const auto left = [&](int index) {
    std::vector<std::optional<double>> squares(some.size());
    const PageResponse response(index);
    parallelFor(context, static_cast<int>(some.size()), kPointsPerBlock, [&](int begin, int end) {
      PointPixels pixels;
      for (int k = begin; k < end; ++k) squares[k] = placers[some[k].course].squaresAt(some[k].point, response, pixels);
    });
    std::vector<double> known;
    for (const auto& sum : squares)
      if (sum) known.push_back(*sum);
    // Discard a blur that does not fit at least half of the strokes.
    if (known.size() < some.size() / 2 || known.empty()) return std::numeric_limits<double>::infinity();
    return upperMedian(known);
  };
  makeTables({kStartBlur - kBlurStrides[0], kStartBlur, kStartBlur + kBlurStrides[0]}, context);
  return leastBlur(kStartBlur, kBlurStrides, left);
}

void placePoint(CoursePoint& p, const PlacedStroke& placed) {
  p.information = placed.information;
  p.shift = static_cast<float>(placed.stroke.middle);
  p.measuredWidth = static_cast<float>(placed.stroke.width);
}

void moveBase(StrokeCourse& c, double blur) {
  std::vector<Vec2> base, normal;
  for (CoursePoint& p : c.points) {
    normal.push_back(leftNormal(p.tangent));
    base.push_back(p.base + static_cast<double>(p.shift) * normal.back());
    p.shift = 0.0f;
  }
  undoCurvatureShift(base, normal, c.closed, blur);
  setValues(c, &CoursePoint::base, base);
}

}  // namespace

void placeOnPixels(std::vector<StrokeCourse>& courses, const GreyImage& grey, const RunContext& context) {
  std::vector<Placer> placers;
  placers.reserve(courses.size());
  for (const StrokeCourse& c : courses) placers.emplace_back(c, grey);
  const PageResponse response(pageBlur(courses, placers, context));
  const auto each = [&](std::ptrdiff_t count, int perBlock, const auto& body) {
    parallelFor(context, static_cast<int>(count), perBlock, [&](int begin, int end) {
      PointPixels pixels;
      for (int k = begin; k < end; ++k) body(k, pixels);
    });
  };
  each(std::ssize(courses), 1, [&](int k, PointPixels& pixels) {
    placers[k].tune(response, pixels);
    placers[k].tune(response, pixels);
  });
  // A page is often one long line: the points are shared among the threads, not the lines.
  std::vector<CoursePlace> places;
  for (int c = 0; c < std::ssize(courses); ++c)
    for (int i = 0; i < courses[c].count(); ++i) places.push_back({c, i});
  each(std::ssize(places), kPointsPerBlock, [&](int k, PointPixels& pixels) {
    const auto [course, i] = places[k];
    CoursePoint& p = courses[course].points[i];
    p.information.reset();
    if (!placers[course].canPlace(i)) return;
    if (const auto placed = placers[course].place(i, response, pixels)) placePoint(p, *placed);
  });
  const double own = response.pixels.blur();
  const double blur = std::sqrt(own * own + kPixelVariance + PixelWindow::kVariance);
  each(std::ssize(courses), 1, [&](int k, PointPixels&) {
    moveBase(courses[k], blur);
    courses[k].wasPlacedOnPixels = true;
  });
}

}  // namespace batten
