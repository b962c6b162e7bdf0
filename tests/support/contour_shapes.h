// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten::test {

/// How a page is rendered from an exact inside test.
struct RenderSettings {
  int width = 200, height = 200;
  double paper = 230.0, ink = 40.0;  ///< [grey]
  double blurPx = 1.2;               ///< [px] Gaussian after exact area sampling (6 x 6).
  double noise = 0.0;                ///< [grey] white, standard deviation.
  unsigned seed = 1;
  double slope = 0.0;  ///< [grey/px] gradation of paper and ink along x.
};

/// Renders `inside` (image frame, px): area sampling, separable Gaussian, noise, 16-bit quantisation.
inline GreyImage renderShape(const std::function<bool(double, double)>& inside, const RenderSettings& s) {
  constexpr int kSub = 6;
  const std::ptrdiff_t w = s.width;
  std::vector<double> cover(w * s.height), across(cover.size());
  for (int y = 0; y < s.height; ++y) {
    for (int j = 0; j < kSub; ++j) {
      for (int i = 0; i < kSub * s.width; ++i) {
        if (!inside((i + 0.5) / kSub, y + (j + 0.5) / kSub)) continue;
        cover[y * w + i / kSub] += 1.0 / (kSub * kSub);
      }
    }
  }
  const int half = static_cast<int>(std::ceil(4.0 * s.blurPx));
  std::vector<double> kernel{1.0};
  if (s.blurPx > 0.0) {
    kernel.clear();
    double sum = 0.0;
    for (int k = -half; k <= half; ++k) sum += std::exp(-0.5 * k * k / (s.blurPx * s.blurPx));
    for (int k = -half; k <= half; ++k) kernel.push_back(std::exp(-0.5 * k * k / (s.blurPx * s.blurPx)) / sum);
  }
  const int reach = static_cast<int>(kernel.size()) / 2;
  const auto blurred = [&](const std::vector<double>& from, int x, int y, bool horizontal) {
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k) {
      const int xx = std::clamp(horizontal ? x + k : x, 0, s.width - 1);
      const int yy = std::clamp(horizontal ? y : y + k, 0, s.height - 1);
      sum += kernel[k + reach] * from[yy * w + xx];
    }
    return sum;
  };
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) across[y * w + x] = blurred(cover, x, y, true);
  }
  std::mt19937 random(s.seed);
  std::normal_distribution<double> gauss(0.0, 1.0);
  GreyImage grey(s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      const double c = blurred(across, x, y, false);
      const double level =
          s.paper + c * (s.ink - s.paper) + s.slope * x + (s.noise > 0.0 ? s.noise * gauss(random) : 0.0);
      grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(std::clamp(level, 0.0, 255.0) * GreyImage::kGreyUnit));
    }
  }
  return grey;
}

/// Ink = darker than `level`, after a 3 x 3 mean that keeps noise from making specks.
inline BitImage thresholdMask(const GreyImage& grey, double level) {
  BitImage ink(grey.width, grey.height);
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      double sum = 0.0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          sum += grey.level(std::clamp(x + i, 0, grey.width - 1), std::clamp(y + j, 0, grey.height - 1));
        }
      }
      ink.set(x, y, sum / 9.0 < level);
    }
  }
  return ink;
}

/// Inside test of a closed polygon (even-odd rule). Remembers the crossings of the last row, since pages are rendered
/// row by row.
class PolygonInside {
 public:
  explicit PolygonInside(std::vector<Vec2> polygon) : polygon_(std::move(polygon)) {}
  bool operator()(double x, double y) {
    if (y != y_) {
      y_ = y;
      crossings_.clear();
      for (std::size_t i = 0, j = polygon_.size() - 1; i < polygon_.size(); j = i++) {
        const Vec2 &a = polygon_[i], &b = polygon_[j];
        if ((a.y() > y) != (b.y() > y)) crossings_.push_back(a.x() + (y - a.y()) * (b.x() - a.x()) / (b.y() - a.y()));
      }
    }
    return std::count_if(crossings_.begin(), crossings_.end(), [x](double c) { return c < x; }) % 2 == 1;
  }

 private:
  std::vector<Vec2> polygon_;
  std::vector<double> crossings_;
  double y_ = -1e300;
};

/// A closed outline of quadratic Bezier sides from corner to corner; `bulge` is the control point's distance from the
/// chord, to the left of travel.
struct CurvedPolygon {
  std::vector<Vec2> corners;
  std::vector<double> bulge;
  std::vector<Vec2> sampled(int perSide = 200) const {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i], c = corners[(i + 1) % corners.size()];
      const Vec2 b = 0.5 * (a + c) + bulge[i] * leftNormal((c - a).normalized());
      for (int k = 0; k < perSide; ++k) {
        const double t = k / double(perSide);
        points.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c);
      }
    }
    return points;
  }
};

/// Distance of a point from a closed polyline.
inline double distanceToPolyline(const std::vector<Vec2>& line, const Vec2& p) {
  double best = 1e300;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 a = line[i], d = line[(i + 1) % line.size()] - a;
    const double t = d.squaredNorm() > 0.0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    best = std::min(best, (a + t * d - p).norm());
  }
  return best;
}

}  // namespace batten::test
