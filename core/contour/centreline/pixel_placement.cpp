// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pixel_placement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/subpixel/curvature_shift.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kToneSigma = 6.0;         // points: ink and paper change slowly along a stroke
constexpr double kFarthestPx = 0.3;        // from the half levels
constexpr double kSmallestContrast = 4.0;  // [grey]
constexpr double kProfileVariance = 0.42;  // [px^2] of the smoothing that a profile's middle has seen: .5 px, bilinear
constexpr std::size_t kBlurPoints = 400;   // that vote for the blur
constexpr std::size_t kGainPoints = 60;    // of a stroke that vote for its darkness
constexpr int kGrain = 64;                 // points worked on together; the result does not depend on it
constexpr int kStrokeNewtonSteps = 4;
constexpr double kLargestStepPx = 0.25, kSettledPx = 2e-3;

struct Stroke {
  double middle = 0.0, width = 1.0;  // [px]
};

struct StrokeModel {
  double paper, slope, contrast;
  int direction;
};

int blurIndex(double blur) {
  return std::clamp(static_cast<int>(std::lround(blur / PixelResponse::kStepPx)) - 1, 0, PixelResponse::kBlurs - 1);
}

/// The darkness of a stroke without blur: the profile's middle has lost some of it to the paper.
double fullContrast(double measured, double width, const PixelResponse& response, int direction) {
  const PixelResponse& wide =
      PixelResponse::forBlur(blurIndex(std::sqrt(response.blur() * response.blur() + kProfileVariance)));
  double part = 0.0;
  for (const double u : {-0.2 * width, 0.0, 0.2 * width})
    part += (wide.at(u + 0.5 * width, direction).part - wide.at(u - 0.5 * width, direction).part) / 3.0;
  return measured / std::max(0.2, part);
}

double inkPart(const PixelResponse& response, const StrokeModel& m, const Stroke& s, double distance) {
  const double u = distance - s.middle;
  return response.at(u + 0.5 * s.width, m.direction).part - response.at(u - 0.5 * s.width, m.direction).part;
}

double squaresLeft(const PixelWindow& window, const PixelResponse& response, const StrokeModel& m, const Stroke& s) {
  double sum = 0.0;
  for (const PixelWindow::Pixel& p : window.pixels) {
    const double e = p.grey - (m.paper + m.slope * p.distance - m.contrast * inkPart(response, m, s, p.distance));
    sum += p.weight * e * e;
  }
  return sum;
}

/// Sums over the pixels for the step of both borders.
struct BorderSums {
  double ll = 0.0, lh = 0.0, hh = 0.0, l = 0.0, h = 0.0;  // by weight: normal equations, right side
  double wll = 0.0, wlh = 0.0, whh = 0.0;                 // by weight squared
  double squares = 0.0, weights = 0.0;
  double det() const { return ll * hh - lh * lh; }

  void add(const PixelWindow::Pixel& p, double e, double dl, double dh) {
    const double w = p.weight, w2 = w * w;
    ll += w * dl * dl;
    lh += w * dl * dh;
    hh += w * dh * dh;
    l += w * dl * e;
    h += w * dh * e;
    wll += w2 * dl * dl;
    wlh += w2 * dl * dh;
    whh += w2 * dh * dh;
    squares += w * e * e;
    weights += w;
  }
  /// What they tell of the middle: weighted least squares under white noise.
  PointInformation information() const {
    const double a = (hh - lh) / det(), b = (ll - lh) / det();  // (1 1) times the inverse
    const double gain = 0.5 * std::sqrt(std::max(0.0, a * a * wll + 2.0 * a * b * wlh + b * b * whh));
    const double taken = (hh * l * l - 2.0 * lh * l * h + ll * h * h) / det();
    const double used = (hh * wll - 2.0 * lh * wlh + ll * whh) / det();
    return {gain, std::max(0.0, squares - taken), std::max(0.0, weights - used)};
  }
};

/// Newton steps for both borders.
std::optional<Stroke> mostLikely(const PixelWindow& window, const PixelResponse& response, const StrokeModel& m,
                                 double width, PointInformation* information) {
  double low = -0.5 * width, high = 0.5 * width;
  for (int step = 0; step < kStrokeNewtonSteps; ++step) {
    BorderSums sums;
    for (const PixelWindow::Pixel& p : window.pixels) {
      const auto in = response.at(p.distance - low, m.direction), out = response.at(p.distance - high, m.direction);
      const double e = p.grey - (m.paper + m.slope * p.distance - m.contrast * (in.part - out.part));
      sums.add(p, e, m.contrast * in.slope, -m.contrast * out.slope);
    }
    const double det = sums.det();
    if (!(det > 1e-3 * sums.ll * sums.hh)) return std::nullopt;
    if (information) *information = sums.information();
    const double moveLow = std::clamp((sums.hh * sums.l - sums.lh * sums.h) / det, -kLargestStepPx, kLargestStepPx);
    const double moveHigh = std::clamp((sums.ll * sums.h - sums.lh * sums.l) / det, -kLargestStepPx, kLargestStepPx);
    low += moveLow;
    high += moveHigh;
    if (!(high - low > 0.2)) return std::nullopt;
    if (std::abs(moveLow) + std::abs(moveHigh) < kSettledPx) break;
  }
  return Stroke{0.5 * (low + high), high - low};
}

/// Tones and widths as they are along the stroke, without the noise of single profiles.
struct Smoothed {
  std::vector<float> contrast, paper, slope, width;
};

Smoothed smoothed(const StrokeCourse& c) {
  const std::size_t n = c.base.size();
  std::vector<float> weight(n), contrast(n), paper(n), slope(n), width(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!c.measured[i] || c.tone[i].contrast <= 0.0f) continue;
    weight[i] = 1.0f;
    contrast[i] = c.tone[i].contrast;
    paper[i] = c.tone[i].paper;
    slope[i] = c.tone[i].slope;
    width[i] = c.measuredWidth[i];
  }
  const std::vector<float> sum = smoothValues(weight, c.closed, kToneSigma);
  const auto mean = [&](const std::vector<float>& v) {
    std::vector<float> out = smoothValues(v, c.closed, kToneSigma);
    for (std::size_t i = 0; i < n; ++i) out[i] = sum[i] > 0.0f ? out[i] / sum[i] : 0.0f;
    return out;
  };
  return {mean(contrast), mean(paper), mean(slope), mean(width)};
}

class Placer {
 public:
  Placer(const StrokeCourse& course, const GreyImage& grey) : c_(course), grey_(grey), s_(smoothed(course)) {}

  bool canPlace(std::size_t i) const {
    return c_.measured[i] && c_.part[i] == StrokePart::Ink && s_.contrast[i] > kSmallestContrast;
  }
  /// Measures by how much the darkness that profiles show differs from that of the pixels' own model.
  void tune(const PixelResponse& response, PixelWindow& window) {
    const std::size_t stride = std::max<std::size_t>(1, c_.base.size() / kGainPoints);
    double top = 0.0, bottom = 0.0;
    for (std::size_t i = 0; i < c_.base.size(); i += stride) {
      if (!canPlace(i)) continue;
      const auto stroke = place(i, response, window);
      if (!stroke) continue;
      const StrokeModel m = modelAt(i, response);
      for (const PixelWindow::Pixel& p : window.pixels) {
        const double model = m.contrast * inkPart(response, m, *stroke, p.distance);
        top += p.weight * model * (m.paper + m.slope * p.distance - p.grey);
        bottom += p.weight * model * model;
      }
    }
    if (bottom > 0.0) gain_ *= std::clamp(top / bottom, 0.8, 1.25);
  }
  /// The stroke at point i and, where asked for, what the model leaves there and how well the pixels tell.
  std::optional<Stroke> place(std::size_t i, const PixelResponse& response, PixelWindow& window, double* left = nullptr,
                              PointInformation* information = nullptr) const {
    const Vec2 normal = leftNormal(c_.tangent[i]);
    const double width = s_.width[i];
    const double reach = std::min(0.5 * width + response.reach() + kFarthestPx, static_cast<double>(c_.tone[i].reach));
    window.read(grey_, c_.base[i], normal, -reach, reach);
    const StrokeModel m = modelAt(i, response);
    const auto stroke = mostLikely(window, response, m, width, information);
    if (!stroke || std::abs(stroke->middle) > kFarthestPx || std::abs(stroke->width - width) > 0.3 * width + 0.3)
      return std::nullopt;
    if (left) *left = squaresLeft(window, response, m, *stroke);
    return stroke;
  }

 private:
  StrokeModel modelAt(std::size_t i, const PixelResponse& response) const {
    StrokeModel m{s_.paper[i], s_.slope[i], 0.0, response.direction(leftNormal(c_.tangent[i]))};
    m.contrast = gain_ * fullContrast(s_.contrast[i], s_.width[i], response, m.direction);
    return m;
  }

  const StrokeCourse& c_;
  const GreyImage& grey_;
  Smoothed s_;
  double gain_ = 1.0;
};

/// A point of one of the courses.
struct Place {
  std::size_t course, point;
};

int pageBlur(const std::vector<StrokeCourse>& courses, const std::vector<Placer>& placers, const RunContext& context) {
  std::vector<Place> all, some;
  for (std::size_t c = 0; c < courses.size(); ++c)
    for (std::size_t i = 0; i < courses[c].base.size(); i += 5)
      if (placers[c].canPlace(i)) all.push_back({c, i});
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kBlurPoints);
  for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
  const auto left = [&](int index) {
    std::vector<double> squares(some.size(), -1.0);
    parallelFor(context, static_cast<int>(some.size()), kGrain, [&](int begin, int end) {
      PixelWindow window;
      for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
        placers[some[k].course].place(some[k].point, PixelResponse::forBlur(index), window, &squares[k]);
    });
    std::erase_if(squares, [](double sum) { return sum < 0.0; });
    if (squares.size() < some.size() / 2 || squares.empty()) return 1e300;  // does not describe these strokes
    return upperMedian(squares);
  };
  constexpr int kStart = 12;  // .65 px
  int best = kStart;
  double least = left(best);
  // Downhill in ever shorter strides: what is left has one minimum.
  for (const int far : {6, 2, 1}) {
    for (const int step : {-far, far}) {
      for (int next = best + step; next >= 0 && next < PixelResponse::kBlurs; next += step) {
        const double sum = left(next);
        if (!(sum < least)) break;
        least = sum;
        best = next;
      }
    }
  }
  return best;
}

void placeOne(StrokeCourse& c, const Placer& placer, std::size_t i, const PixelResponse& response,
              PixelWindow& window) {
  if (!placer.canPlace(i)) return;
  PointInformation information;
  const auto stroke = placer.place(i, response, window, nullptr, &information);
  if (!stroke) return;
  c.information[i] = information;
  c.shift[i] = static_cast<float>(stroke->middle);
  c.measuredWidth[i] = static_cast<float>(stroke->width);
}

void moveBase(StrokeCourse& c, double blur) {
  std::vector<Vec2> normal;
  for (const Vec2& t : c.tangent) normal.push_back(leftNormal(t));
  for (std::size_t i = 0; i < c.base.size(); ++i) c.base[i] += static_cast<double>(c.shift[i]) * normal[i];
  std::fill(c.shift.begin(), c.shift.end(), 0.0f);
  undoCurvatureShift(c.base, normal, c.closed, blur);
}

}  // namespace

void placeOnPixels(std::vector<StrokeCourse>& courses, const GreyImage& grey, const RunContext& context) {
  std::vector<Placer> placers;
  for (const StrokeCourse& c : courses) placers.emplace_back(c, grey);
  const PixelResponse& response = PixelResponse::forBlur(pageBlur(courses, placers, context));
  const auto each = [&](std::size_t count, int grain, const auto& body) {
    parallelFor(context, static_cast<int>(count), grain, [&](int begin, int end) {
      PixelWindow window;
      for (int k = begin; k < end; ++k) body(static_cast<std::size_t>(k), window);
    });
  };
  each(courses.size(), 1, [&](std::size_t k, PixelWindow& window) {
    placers[k].tune(response, window);
    placers[k].tune(response, window);
  });
  // A page is often one long line: the points are shared among the threads, not the lines.
  std::vector<Place> places;
  for (StrokeCourse& c : courses) c.information.assign(c.base.size(), {});
  for (std::size_t c = 0; c < courses.size(); ++c)
    for (std::size_t i = 0; i < courses[c].base.size(); ++i) places.push_back({c, i});
  each(places.size(), kGrain, [&](std::size_t k, PixelWindow& window) {
    placeOne(courses[places[k].course], placers[places[k].course], places[k].point, response, window);
  });
  const double blur = std::sqrt(response.blur() * response.blur() + kPixelVariance + PixelWindow::kVariance);
  each(courses.size(), 1, [&](std::size_t k, PixelWindow&) { moveBase(courses[k], blur); });
}

}  // namespace batten
