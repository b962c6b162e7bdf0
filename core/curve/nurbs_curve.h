// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"

namespace batten {

/// Of curves in this program; what is evaluated lies in arrays of this size + 1.
inline constexpr int kMaxDegree = 7;

/// A NURBS curve of the plane. Immutable: a curve that exists is valid (degree >= 1, non-decreasing finite knots,
/// number of knots = control points + degree + 1, no knot of multiplicity above degree + 1, positive domain, positive
/// weights). The domain is [knots[degree], knots[n]] with n = number of control points. Copies share their data.
class NurbsCurve {
 public:
  /// An empty placeholder (isEmpty() is true); every other function but assignment needs a made curve.
  NurbsCurve() = default;

  /// @param weights one per control point, or empty for a non-rational curve (all weights 1 are stored as empty).
  /// @return Numerical error naming what is wrong.
  static Result<NurbsCurve> make(int degree, std::vector<double> knots, std::vector<Vec2> controlPoints,
                                 std::vector<double> weights = {});

  bool isEmpty() const { return data_ == nullptr; }
  int degree() const;
  int controlPointCount() const;
  std::span<const double> knots() const;
  std::span<const Vec2> controlPoints() const;
  std::span<const double> weights() const;  ///< Empty: non-rational.
  bool isRational() const;
  double start() const;  ///< First parameter of the domain.
  double end() const;    ///< Last parameter of the domain.

  /// Position at u; u is clamped to the domain.
  Vec2 point(double u) const;
  /// Position and derivatives with respect to u up to order `order` (0..4): result[d]. At an inner knot the right
  /// limit, at the end the left limit. Piegl & Tiller, The NURBS Book, A3.2 and A4.2.
  std::array<Vec2, 5> derivatives(double u, int order) const;

  /// Distinct knots of the domain, both ends included: the borders of the polynomial spans.
  std::vector<double> breaks() const;

  /// The same curve under an affine map of its control points (exact).
  NurbsCurve mapped(const Eigen::Matrix2d& linear, const Vec2& offset) const;

  bool operator==(const NurbsCurve& other) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// Index s of the span of u: knots[s] <= u < knots[s + 1] within the domain, which u is clamped to; at its end the last
/// span that is not empty.
int spanOf(int degree, std::span<const double> knots, int controlPointCount, double u);

/// Values and derivatives 0..order of the degree+1 basis functions that are not zero in the span of u:
/// values[d][j], first = index of the control point of j = 0. Piegl & Tiller A2.3.
struct BasisRow {
  int first = 0;
  std::array<std::array<double, 8>, 5> values{};
};
/// @pre degree <= 7, u in the domain.
BasisRow basis(int degree, std::span<const double> knots, int controlPointCount, double u, int order);

}  // namespace batten
