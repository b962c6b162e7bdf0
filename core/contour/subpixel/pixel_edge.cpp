// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/pixel_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <numbers>

namespace batten {
namespace {

constexpr double kNarrowSide = 0.15;  // [px] a projected side below this counts as blur: else 1 / side loses digits

double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }
double distribution(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// The normal distribution of standard deviation s, and its first and second integral.
struct NormalIntegrals {
  double part, once, twice;
};
NormalIntegrals integralsOf(double x, double s) {
  const double p = distribution(x / s), d = density(x / s);
  return {p, x * p + s * d, 0.5 * ((x * x + s * s) * p + x * s * d)};
}

struct Answer {
  double part, slope;
};

constexpr double kReachBlurs = 2.5;  // of blur: farther from the edge the answer is 0 or 1 to 1 %,
constexpr double kRangeBlurs = 4.0;  // and farther than this to 3e-5
constexpr int kEdgeNewtonSteps = 4;  // from what the profiles found; fewer once settled
constexpr double kLargestEdgeStepPx = 0.5, kSettledEdgePx = 2e-3;  // of one step; a smaller one changes nothing

PixelResponse::Value modelAt(const PixelResponse& response, const PixelEdge& edge, double distance) {
  PixelResponse::Value value = response.at(distance, edge.direction);
  const auto& [ink, paper] = edge.twins;
  if (ink) value.part -= response.at(distance - *ink, edge.direction).part;
  if (paper) value.part += response.at(-distance - *paper, edge.direction).part;
  return value;
}

// Sums over the pixels for a step of an edge.
struct EdgeSums {
  double top = 0.0, bottom = 0.0, spread = 0.0, squares = 0.0, weights = 0.0;
  void add(double weight, double gradient, double left) {
    const double weighted = weight * gradient;
    top += weighted * left;
    bottom += weighted * gradient;
    spread += weighted * weighted;
    squares += weight * left * left;
    weights += weight;
  }
  // Weighted least squares under white noise; one step more takes its part of the squares.
  PointInformation information() const {
    return {std::sqrt(spread) / bottom, std::max(0.0, squares - top * top / bottom),
            std::max(0.0, weights - spread / bottom)};
  }
};

// The square seen along the edge is a trapezium: two boxes of widths a >= b, one after the other.
Answer answerOf(double d, double a, double b, double s) {
  if (b < kNarrowSide) {
    const double wide = std::hypot(s, b / std::sqrt(12.0));
    const NormalIntegrals hi = integralsOf(d + 0.5 * a, wide), lo = integralsOf(d - 0.5 * a, wide);
    return {(hi.once - lo.once) / a, (hi.part - lo.part) / a};
  }
  const double outer = 0.5 * (a + b), inner = 0.5 * (a - b);
  const NormalIntegrals last = integralsOf(d + outer, s), third = integralsOf(d + inner, s),
                        second = integralsOf(d - inner, s), first = integralsOf(d - outer, s);
  return {(last.twice - third.twice - second.twice + first.twice) / (a * b),
          (last.once - third.once - second.once + first.once) / (a * b)};
}

}  // namespace

PixelResponse::PixelResponse(double blur) : blur_(blur) {
  range_ = 1.0 + kRangeBlurs * blur;
  columns_ = 2 * static_cast<int>(std::ceil(range_ * kPerPx)) + 2;
  range_ = 0.5 * (columns_ - 2) / kPerPx;
  values_.reserve(std::ptrdiff_t{2} * kDirections * columns_);
  for (int row = 0; row < kDirections; ++row) {
    const double angle = 0.25 * std::numbers::pi * row / (kDirections - 1);
    const double a = std::cos(angle), b = std::sin(angle);
    for (int k = 0; k < columns_; ++k) {
      const Answer answer = answerOf(static_cast<double>(k) / kPerPx - range_, a, b, blur);
      values_.push_back(static_cast<float>(answer.part));
      values_.push_back(static_cast<float>(answer.slope));
    }
  }
}

double PixelResponse::reachOf(double blur) { return 0.5 + kReachBlurs * blur; }

const PixelResponse& PixelResponse::forBlur(int index) {
  static std::array<std::once_flag, kBlurs> made;
  static std::array<std::unique_ptr<const PixelResponse>, kBlurs> tables;
  std::call_once(made[index], [&] { tables[index].reset(new PixelResponse((index + 1) * kStepPx)); });
  return *tables[index];
}

int PixelResponse::direction(const Vec2& normal) const {
  const double x = std::abs(normal.x()), y = std::abs(normal.y());
  const double angle = std::atan2(std::min(x, y), std::max(x, y));
  return static_cast<int>(std::lround(angle / (0.25 * std::numbers::pi) * (kDirections - 1)));
}

EdgePosition mostLikelyPosition(const PixelWindow& window, const PixelResponse& response, const PixelEdge& edge,
                                double start, double gate) {
  double position = start;
  const double reach = response.reach();
  std::optional<EdgeSums> known;
  const auto information = [&] { return known ? std::optional(known->information()) : std::nullopt; };
  for (int step = 0; step < kEdgeNewtonSteps; ++step) {
    EdgeSums sums;
    for (int i = 0; i < window.count(); ++i) {
      const double distance = window.distance()[i] - position;
      if (std::abs(distance) > reach) continue;
      const auto model = modelAt(response, edge, distance);
      const double gradient = edge.contrast * model.slope;  // of the grey with respect to the position
      sums.add(window.weight()[i], gradient, window.grey()[i] - (edge.paper - edge.contrast * model.part));
    }
    if (!(sums.bottom > 0.0)) return {start, information()};
    known = sums;
    const double move = std::clamp(sums.top / sums.bottom, -kLargestEdgeStepPx, kLargestEdgeStepPx);
    position = std::clamp(position + move, start - gate, start + gate);
    if (std::abs(move) < kSettledEdgePx) break;
  }
  return {position, information()};
}

double squaresLeft(const PixelWindow& window, const PixelResponse& response, const PixelEdge& edge, double position) {
  double sum = 0.0;
  for (int i = 0; i < window.count(); ++i) {
    const double part = modelAt(response, edge, window.distance()[i] - position).part;
    const double e = window.grey()[i] - (edge.paper - edge.contrast * part);
    sum += window.weight()[i] * e * e;
  }
  return sum;
}

}  // namespace batten
