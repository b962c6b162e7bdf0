// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/pixel_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>

namespace batten {
namespace {

constexpr double kNarrowSide = 0.15;  // [px] a projected side below this counts as blur: else 1 / side loses digits

double density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }
double distribution(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// First and second integral of the normal distribution of standard deviation s.
double once(double x, double s) { return x * distribution(x / s) + s * density(x / s); }
double twice(double x, double s) { return 0.5 * ((x * x + s * s) * distribution(x / s) + x * s * density(x / s)); }

struct Answer {
  double part, slope;
};

constexpr double kReachBlurs = 2.5;  // of blur: farther from the edge the answer is 0 or 1 to 1 %,
constexpr double kRangeBlurs = 4.0;  // and farther than this to 3e-5
constexpr double kParallel = 1e-9;   // cosine: a row that runs along a strip crosses no side of it
constexpr int kEdgeNewtonSteps = 4;
constexpr double kLargestEdgeStepPx = 0.5, kSettledEdgePx = 2e-3;

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
    const double hi = d + 0.5 * a, lo = d - 0.5 * a;
    return {(once(hi, wide) - once(lo, wide)) / a, (distribution(hi / wide) - distribution(lo / wide)) / a};
  }
  const double outer = 0.5 * (a + b), inner = 0.5 * (a - b);
  return {(twice(d + outer, s) - twice(d + inner, s) - twice(d - inner, s) + twice(d - outer, s)) / (a * b),
          (once(d + outer, s) - once(d + inner, s) - once(d - inner, s) + once(d - outer, s)) / (a * b)};
}

}  // namespace

PixelResponse::PixelResponse(double blur) : blur_(blur) {
  reach_ = 0.5 + kReachBlurs * blur;
  range_ = 1.0 + kRangeBlurs * blur;
  columns_ = 2 * static_cast<int>(std::ceil(range_ * kPerPx)) + 2;
  range_ = 0.5 * (columns_ - 2) / kPerPx;
  for (int row = 0; row < kDirections; ++row) {
    const double angle = 0.25 * std::numbers::pi * row / (kDirections - 1);
    const double a = std::cos(angle), b = std::sin(angle);
    for (int k = 0; k < columns_; ++k) {
      const Answer answer = answerOf(static_cast<double>(k) / kPerPx - range_, a, b, blur);
      part_.push_back(static_cast<float>(answer.part));
      slope_.push_back(static_cast<float>(answer.slope));
    }
  }
}

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

void PixelWindow::read(const GreyImage& grey, const Vec2& base, const Vec2& normal, double lo, double hi) {
  pixels.clear();
  const Vec2 along(normal.y(), -normal.x());
  const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  const Vec2 centre = base + middle * normal;
  const double height = std::abs(normal.y()) * half + std::abs(along.y()) * kHalfPx;
  const int top = std::max(0, static_cast<int>(std::ceil(centre.y() - height - 0.5)));
  const int bottom = std::min(grey.height - 1, static_cast<int>(std::floor(centre.y() + height - 0.5)));
  for (int y = top; y <= bottom; ++y) {
    // Where the row of pixel centres crosses the two strips |along| < kHalfPx and lo..hi.
    const double dy = y + 0.5 - centre.y();
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    double from = -kEndless, to = kEndless;
    const auto cut = [&](double rate, double offset, double limit) {
      if (std::abs(rate) < kParallel) {
        if (std::abs(offset) > limit) to = -kEndless;
        return;
      }
      const double a = (-limit - offset) / rate, b = (limit - offset) / rate;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    };
    cut(normal.x(), dy * normal.y(), half);
    cut(along.x(), dy * along.y(), kHalfPx);
    if (!(from <= to)) continue;
    const int first = std::max(0, static_cast<int>(std::ceil(centre.x() + from - 0.5)));
    const int last = std::min(grey.width - 1, static_cast<int>(std::floor(centre.x() + to - 0.5)));
    const std::uint16_t* row = grey.row(y);
    if (first > last) continue;
    pixels.resize(pixels.size() + static_cast<std::size_t>(last - first + 1));
    Pixel* next = &*(pixels.end() - (last - first + 1));
    for (int x = first; x <= last; ++x) {
      const double dx = x + 0.5 - centre.x();
      const double s = dx * along.x() + dy * along.y();
      *next++ = {dx * normal.x() + dy * normal.y() + middle, std::max(0.0, 1.0 - std::abs(s) / kHalfPx),
                 row[x] / GreyImage::kGreyUnit};
    }
  }
}

EdgePosition mostLikelyPosition(const PixelWindow& window, const PixelResponse& response, const PixelEdge& edge,
                                double start, double gate) {
  double position = start;
  std::optional<EdgeSums> known;
  const auto information = [&] { return known ? std::optional(known->information()) : std::nullopt; };
  for (int step = 0; step < kEdgeNewtonSteps; ++step) {
    EdgeSums sums;
    for (const PixelWindow::Pixel& p : window.pixels) {
      if (std::abs(p.distance - position) > response.reach()) continue;
      const auto model = modelAt(response, edge, p.distance - position);
      const double gradient = edge.contrast * model.slope;  // of the grey with respect to the position
      sums.add(p.weight, gradient, p.grey - (edge.paper - edge.contrast * model.part));
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
  for (const PixelWindow::Pixel& p : window.pixels) {
    const double e = p.grey - (edge.paper - edge.contrast * modelAt(response, edge, p.distance - position).part);
    sum += p.weight * e * e;
  }
  return sum;
}

}  // namespace batten
