// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"
#include "core/solve/banded_matrix.h"
#include "core/solve/gauss_legendre.h"

namespace batten {

/// The space of uniform quintic splines over [0, length] with `spans` spans: open ones have spans + 5 coefficients (the
/// knots run on for 5 spacings beyond both ends), periodic ones have `spans`. @pre spans >= 1 (closed: >= 6), length >
/// 0.
struct UniformKnots {
  double length = 1.0;  ///< Of the domain.
  int spans = 1;
  bool closed = false;

  double spacing() const { return length / spans; }
  int coefficients() const { return closed ? spans : spans + 5; }
  /// The six basis values of derivative `order` (0..4) at u; closed: u modulo length. Beyond open ends the end
  /// polynomial runs on.
  BandRow row(double u, int order) const;
  /// Those of the orders 0 and 1.
  std::array<BandRow, 2> firstRows(double u) const;
  /// Those of the orders 0 to 4; `bendOnly` leaves the third out.
  std::array<BandRow, 5> rows(double u, bool bendOnly) const;
  struct Place {
    int span = 0;
    double at = 0.0;  ///< 0..1 inside the domain.
  };
  Place placeOf(double u) const;
};

/// Positions with derivatives at a parameter: d[k] = k-th derivative.
using PlaneDerivatives = std::array<Vec2, 5>;

/// A plane curve in such a space, with its polynomials at hand for fast evaluation.
class UniformQuintic {
 public:
  UniformQuintic() = default;
  UniformQuintic(const UniformKnots& knots, std::vector<Vec2> coefficients);

  const UniformKnots& knots() const { return knots_; }
  /// Value and derivatives up to `order` (0..4).
  PlaneDerivatives at(double u, int order) const;
  /// Arc length from 0 to the start of every span, and the total: spans + 1 numbers.
  const std::vector<double>& spanLengths() const { return spanLengths_; }
  double length() const { return spanLengths_.back(); }
  /// Arc length at u; beyond open ends the curve runs on. Closed: u in [0, length of the domain].
  double arcLength(double u) const;
  /// Parameter of the foot point of `p` near `start` (Newton). Open: kept within `beyond` of the domain. Closed: not
  /// reduced.
  double footPoint(const Vec2& p, double start, double beyond) const;
  /// The same curve with clamped ends, which are moved; what lies between moves by both in turn, by the share of the
  /// way.
  Result<NurbsCurve> toNurbs(const Vec2& startShift = Vec2::Zero(), const Vec2& endShift = Vec2::Zero()) const;

 private:
  UniformKnots knots_;
  std::vector<Vec2> coefficients_;
  std::vector<std::array<Vec2, 6>> polynomials_;  ///< Per span, powers of the place in the span (0..1).
  std::vector<double> spanLengths_;
  double perUnit_ = 1.0;                       ///< Spans per unit of the parameter.
  std::vector<std::array<double, 4>> speeds_;  ///< Per span, powers of the place: the cubic through the Gauss nodes.
};

/// The lambda of fitUniformQuintic() that halves waves of this length, for points of this density along the curve, each
/// of weight 1. Both in the unit of the parameter.
inline double cutoffPenalty(double density, double cutoff) {
  return density * std::pow(cutoff / (2.0 * std::numbers::pi), 6);
}

/// Least squares curve through points with parameters and weights plus lambda * integral |P'''|^2. Absent when
/// singular.
std::optional<UniformQuintic> fitUniformQuintic(const UniformKnots& knots, std::span<const double> parameters,
                                                std::span<const Vec2> points, std::span<const double> weights,
                                                double lambda);

/// The rule that integrates over a span, 0..1.
inline constexpr auto kSpanRule = gaussLegendre<4>(0.0, 1.0);

}  // namespace batten
