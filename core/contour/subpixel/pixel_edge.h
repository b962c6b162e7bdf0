// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/point_noise.h"
#include "core/image/grey_image.h"

namespace batten {

/// What a pixel shows of a straight edge: the part of its area beyond the edge, after Gaussian blur of the light. A
/// pixel is a square, so the answer depends on the direction of the edge; a model without that is wrong by an amount
/// that beats with the pixel grid, up to some hundredths of a pixel on unblurred pages. Tabulated, error < 3e-4.
class PixelResponse {
 public:
  static constexpr double kStepPx = 0.05;  ///< [px] of the blurs there are tables for.
  static constexpr int kBlurs = 50;
  /// The table for a blur of (index + 1) * kStepPx, made when first asked for. Thread safe. @pre 0 <= index < kBlurs.
  static const PixelResponse& forBlur(int index);
  /// [px] Standard deviation of the Gaussian.
  double blur() const { return blur_; }
  /// [px] Beyond this distance the answer is 0 or 1 to 1 %.
  double reach() const { return reach_; }

  /// The row for edges with this unit normal.
  int direction(const Vec2& normal) const;
  struct Value {
    double part;   ///< 0..1: how much of the pixel is ink.
    double slope;  ///< [1/px] its derivative with respect to the distance.
  };
  /// For a pixel whose centre is `distance` px inside the ink (negative: outside).
  Value at(double distance, int direction) const {
    const double place = (distance + range_) * kPerPx;
    if (!(place > 0.0)) return {0.0, 0.0};
    if (place >= columns_ - 2) return {1.0, 0.0};
    const int k = static_cast<int>(place);
    const double f = place - k;
    const int i = direction * columns_ + k;
    return {part_[i] + f * (part_[i + 1] - part_[i]), slope_[i] + f * (slope_[i + 1] - slope_[i])};
  }

 private:
  explicit PixelResponse(double blur);
  static constexpr int kPerPx = 32, kDirections = 33;
  double blur_, reach_, range_;
  int columns_;
  std::vector<float> part_, slope_;
};

inline constexpr double kPixelVariance = 1.0 / 12.0;  ///< [px^2] of a square pixel along any direction.

/// The raw pixels around a place of an edge.
struct PixelWindow {
  static constexpr double kHalfPx = 1.0;                        ///< [px] along the edge; weights fall to 0 there.
  static constexpr double kVariance = kHalfPx * kHalfPx / 6.0;  ///< [px^2] of the weights along the edge.
  struct Pixel {
    double distance;  ///< [px] of its centre along the normal.
    double weight;    ///< 1 - |along| / kHalfPx.
    double grey;      ///< [grey]
  };
  std::vector<Pixel> pixels;
  /// Those with lo <= distance <= hi. Pixels beyond the page are left out.
  void read(const GreyImage& grey, const Vec2& base, const Vec2& normal, double lo, double hi);
};

/// A straight edge, and the borders of the same ink or gap that are in sight.
struct PixelEdge {
  double paper = 255.0, contrast = 0.0;  ///< [grey] of the paper, and how much darker the ink is.
  EdgeTwins twins = {};                  ///< [px]
  int direction = 0;                     ///< Of PixelResponse.
};

/// A position that the pixels told.
struct EdgePosition {
  double position = 0.0;                             ///< [px] along the normal.
  std::optional<PointInformation> information = {};  ///< How well the pixels tell; absent where they say nothing.
};
/// The position along the normal that the pixels make most likely under white noise: Newton steps from `start`, at most
/// `gate` px away from it. `start` when the pixels say nothing.
EdgePosition mostLikelyPosition(const PixelWindow&, const PixelResponse&, const PixelEdge&, double start, double gate);
/// [grey^2] weighted sum of the squares that the model leaves.
double squaresLeft(const PixelWindow&, const PixelResponse&, const PixelEdge&, double position);

}  // namespace batten
