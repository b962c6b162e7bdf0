// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/vec2.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

/// A place on a piecewise polynomial curve: span number and position 0..1 within it.
struct SpanPlace {
  int span = 0;
  double tau = 0.0;
};

/// Values and derivatives 0..4 with respect to the parameter of the degree + 1 basis functions of a span.
struct SpanRow {
  std::array<std::array<double, kMaxDegree + 1>, 5> d{};
};

/// The B-spline basis of a knot vector as polynomials per span, computed once: fairing evaluates the same basis some
/// hundred thousand times. `wrap` > 0: periodic, control point j is j modulo wrap.
class SpanBasis {
 public:
  SpanBasis() = default;
  /// @pre a valid knot vector for `count` control points, 1 <= degree <= kMaxDegree.
  SpanBasis(int degree, std::span<const double> knots, int count, int wrap);

  int degree() const { return degree_; }
  int spanCount() const { return static_cast<int>(first_.size()); }
  int pointCount() const { return wrap_ > 0 ? wrap_ : count_; }
  double begin(int span) const { return breaks_[span]; }
  double width(int span) const { return breaks_[span + 1] - breaks_[span]; }
  /// Where the parameter u lies, clamped to the domain; a knot belongs to the span that begins there.
  SpanPlace place(double u) const;
  double parameter(const SpanPlace& place) const { return begin(place.span) + place.tau * width(place.span); }
  bool isPeriodic() const { return wrap_ > 0; }
  /// Control point that belongs to basis function j = 0..degree of a span.
  int point(int span, int j) const {
    const int index = first_[span] + j;
    return wrap_ > 0 ? index % wrap_ : index;
  }
  SpanRow row(const SpanPlace& place, int order) const;
  /// Coefficient of tau^k in basis function j of a span.
  double coefficient(int span, int k, int j) const {
    return coefficients_[(std::ptrdiff_t{span} * stride() + k) * stride() + j];
  }

 private:
  int stride() const { return degree_ + 1; }
  int degree_ = 0, count_ = 0, wrap_ = 0;
  std::vector<double> breaks_, coefficients_;
  std::vector<int> first_;
};

/// Position and derivatives with respect to the parameter.
using Jet = std::array<Vec2, 5>;

/// A curve over a SpanBasis, which must outlive it.
class SpanCurve {
 public:
  SpanCurve() = default;
  SpanCurve(const SpanBasis& basis, std::span<const Vec2> points);
  const SpanBasis& basis() const { return *basis_; }
  /// Derivatives up to `order` (0..4); those above are zero.
  Jet at(const SpanPlace& place, int order) const;
  double speed(const SpanPlace& place) const;
  struct SpeedRange {
    double least, most;
  };
  /// Of the speeds at `parts` + 1 equally spaced places of a span.
  SpeedRange speedRange(int span, int parts) const;
  /// Those of the powers of the position 0..1 within the span, degree + 1 of them.
  const Vec2* coefficients(int span) const {
    return coefficients_.data() + std::ptrdiff_t{span} * (basis_->degree() + 1);
  }
  /// No second derivative with respect to the position 0..1 within the span is longer: of the curve, and of its
  /// difference to another one over the same basis.
  double bendBound(int span) const;
  double bendBound(const SpanCurve& other, int span) const;

 private:
  const SpanBasis* basis_ = nullptr;
  std::vector<Vec2> coefficients_;
};

/// Places at equal arc length: `count` of them, both ends included, or for a closed curve the end left out.
struct EqualArc {
  double length = 0.0;  ///< Of the whole curve.
  std::vector<SpanPlace> places;
};
/// Absent when the curve has no length or is not finite. The speed of each half span is taken as the polynomial through
/// its values at seven Legendre nodes; the places on its integral are found by safeguarded Newton.
std::optional<EqualArc> equalArcPlaces(const SpanCurve& curve, int count, bool closed, CancelCheck check = {});

/// The foot point of `point` on the curve that Newton's method reaches from `start`; periodic curves run on over the
/// seam, others stop at their ends. Where it does not settle, or ends farther off than it began, as where the curve is
/// slow or bends sharply, it begins anew with steps shortened so that each leads nearer. The first place that is no
/// farther than `enough` ends the search.
SpanPlace footPoint(const SpanCurve& curve, const Vec2& point, SpanPlace start, double enough = 0.0);

}  // namespace batten
