// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/pixel_window.h"
#include "core/contour/subpixel/point_noise.h"
#include "core/contour/subpixel/response_row.h"

namespace batten {

/// What a pixel shows of a straight edge: the part of its area beyond the edge, after Gaussian blur of the light. A
/// pixel is a square, so the answer depends on the direction of the edge; a model without that is wrong by an amount
/// that beats with the pixel grid, up to some hundredths of a pixel on unblurred pages. Tabulated, error < 3e-4.
class PixelResponse {
 public:
  static constexpr double kStepPx = 0.05;  ///< [px] of the blurs there are tables for.
  static constexpr int kBlurs = 50;        ///< Up to 2.5 px, as far as profiles can tell a blur.
  /// The table for a blur of (index + 1) * kStepPx, made at the first request. Thread safe. @pre 0 <= index < kBlurs.
  static const PixelResponse& forBlur(int index);
  /// [px] Standard deviation of the Gaussian.
  double blur() const { return blur_; }
  /// [px] Beyond this distance the answer is 0 or 1 to 1 %.
  double reach() const { return reachOf(blur_); }
  static double reachOf(double blur);

  /// The row for edges with this unit normal.
  int direction(const Vec2& normal) const;
  /// The table for a direction.
  ResponseRow row(int direction) const { return {values_.data() + 2 * direction * columns_, range_, columns_}; }
  using Value = ResponseRow::Value;
  /// For a pixel whose centre is `distance` px inside the ink (negative: outside).
  Value at(double distance, int direction) const { return row(direction).at(distance); }

 private:
  explicit PixelResponse(double blur);
  static constexpr int kPerPx = ResponseRow::kPerPx, kDirections = 33;  // rows over 45 degrees; the others by symmetry
  double blur_, range_;
  int columns_;
  std::vector<float> values_;  ///< By direction and distance: part, slope.
};

inline constexpr double kPixelVariance = 1.0 / 12.0;  ///< [px^2] of a square pixel along any direction.

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
