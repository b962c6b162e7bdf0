// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/span_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/hot_loop.h"
#include "core/curve/foot_step.h"
#include "core/solve/gauss_legendre.h"

namespace batten {
namespace {

constexpr int kPartsPerSpan = 2;  // each with a rule of its own for the arc length

/// Places where the speed is taken on 0..1.
constexpr std::size_t kNodes = 7;
using NodeValues = std::array<double, kNodes>;
constexpr NodeValues kNodeAt = gaussLegendre<kNodes>(0.0, 1.0).node;

/// The arc length over one part of a span, as the integral of the polynomial through the speeds at the nodes: for the
/// whole part the Gauss-Legendre rule, within it as good as that polynomial. So a curve's samples cost no integrals.
class PartLength {
 public:
  PartLength(const SpanCurve& curve, int part) {
    static constexpr auto kLagrange = lagrangePolynomials(kNodeAt);
    const int span = part / kPartsPerSpan;
    const double low = lowOf(part), width = curve.basis().width(span) / kPartsPerSpan;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double v = width * curve.speed({span, low + kNodeAt[k] / kPartsPerSpan});
      for (std::size_t i = 0; i < kNodes; ++i) slope_[i] += v * kLagrange[k][i];
    }
    for (std::size_t i = 0; i < kNodes; ++i) length_[i] = slope_[i] / static_cast<double>(i + 1);
  }
  static double lowOf(int part) { return static_cast<double>(part % kPartsPerSpan) / kPartsPerSpan; }

  double whole() const { return at(1.0); }
  /// The place 0..1 in the part at which its length has reached `wanted`, by safeguarded Newton.
  double placeAt(double wanted, double whole) const {
    constexpr double kSettled = 1e-9, kHalved = 1e-15;  // after a step of Newton's so small the next is rounding
    double low = 0.0, high = 1.0, x = whole > 0.0 ? std::clamp(wanted / whole, 0.0, 1.0) : 0.0;
    for (int step = 0; step < 60; ++step) {
      const double miss = at(x) - wanted;
      (miss > 0.0 ? high : low) = x;
      const double v = slopeAt(x);
      double next = v > 0.0 ? x - miss / v : -1.0;
      const bool isHalved = !(next >= low && next <= high);
      if (isHalved) next = 0.5 * (low + high);
      const bool settled = std::abs(next - x) < (isHalved ? kHalved : kSettled);
      x = next;
      if (settled) break;
    }
    return x;
  }

 private:
  double slopeAt(double x) const {
    double sum = slope_.back();
    for (std::size_t i = kNodes - 1; i-- > 0;) sum = sum * x + slope_[i];
    return sum;
  }
  double at(double x) const {
    double sum = length_.back();
    for (std::size_t i = kNodes - 1; i-- > 0;) sum = sum * x + length_[i];
    return sum * x;
  }
  NodeValues slope_{}, length_{};  ///< Coefficients of the speed, and of the length divided by x.
};

/// Of a polynomial of degree p, its coefficients from the constant one on, and its derivatives: Horner for the Taylor
/// coefficients at tau. The order is known to the compiler, so that all of them stay in registers.
template <std::size_t kOrder>
BATTEN_PART_OF_LOOP std::array<Vec2, kOrder + 1> taylorAt(const Vec2* c, std::size_t p, double tau,
                                                          double inverseWidth) {
  std::array<Vec2, kOrder + 1> jet;
  jet.fill(Vec2::Zero());
  jet[0] = c[p];
  for (std::size_t k = p; k-- > 0;) {
    BATTEN_UNROLL
    for (std::size_t d = kOrder; d >= 1; --d) jet[d] = jet[d] * tau + jet[d - 1];
    jet[0] = jet[0] * tau + c[k];
  }
  double factor = 1.0;
  BATTEN_UNROLL
  for (std::size_t d = 1; d <= kOrder; ++d) {
    factor *= static_cast<double>(d) * inverseWidth;
    jet[d] *= factor;
  }
  return jet;
}

/// Of the basis functions of a span, whose coefficients lie in lines of equal powers.
template <int kDegree>
SpanRow rowOf(const double* coefficients, int anyDegree, double tau, double width, int order) {
  constexpr int kMostOrder = 4;
  const int degree = kDegree == Eigen::Dynamic ? anyDegree : kDegree;
  const std::size_t size = degree + 1;
  SpanRow result;
  double scale = 1.0;
  BATTEN_UNROLL
  for (int d = 0; d <= kMostOrder; ++d) {
    if (d > order) break;
    double* sum = result.d[d].data();
    double power = scale;
    BATTEN_UNROLL
    for (int k = d; k <= degree; ++k) {
      double factor = power;
      for (int i = 0; i < d; ++i) factor *= k - i;
      const double* line = coefficients + k * size;
      for (std::size_t j = 0; j < size; ++j) sum[j] += factor * line[j];
      power *= tau;
    }
    scale /= width;
  }
  return result;
}

template <std::size_t kOrder>
Jet jetAt(const Vec2* c, std::size_t p, double tau, double inverseWidth) {
  constexpr std::size_t kQuintic = 5;  // the usual case, with loops of known lengths
  const auto low =
      p == kQuintic ? taylorAt<kOrder>(c, kQuintic, tau, inverseWidth) : taylorAt<kOrder>(c, p, tau, inverseWidth);
  Jet jet;
  for (std::size_t d = 0; d < jet.size(); ++d) jet[d] = d <= kOrder ? low[std::min(d, kOrder)] : Vec2(Vec2::Zero());
  return jet;
}

/// A place moved along a curve by a part of its span. The remainder of a move over a knot is rescaled to the next
/// span's width; beyond an open end it is the end.
SpanPlace movedAlong(const SpanBasis& basis, const SpanPlace& place, double move) {
  SpanPlace next{place.span, place.tau + move};
  while (next.tau < 0.0 || next.tau > 1.0) {
    const bool back = next.tau < 0.0;
    int span = next.span + (back ? -1 : 1);
    if (span < 0 || span >= basis.spanCount()) {
      if (!basis.isPeriodic()) return {next.span, back ? 0.0 : 1.0};
      span = back ? basis.spanCount() - 1 : 0;
    }
    const double rest = (back ? -next.tau : next.tau - 1.0) * basis.width(next.span) / basis.width(span);
    next = {span, back ? 1.0 - std::min(rest, 1.0) : std::min(rest, 1.0)};
  }
  return next;
}

/// Of a span: a move so small converges, and rounding hides whether it leads nearer.
constexpr double kSurelyNear = 1e-4;

/// Where a search for a foot ended. Distances are squared.
struct FootSearch {
  bool isSettled = false;
  SpanPlace place;
  double begin = 0.0, end = 0.0;  ///< Where the search began, and at the last place it looked at.
};

/// @param isDownhill a move that would lead farther off is shortened.
/// @param enough a place so near, squared, is not improved.
/// @return downhill, unless it settled, the nearest place.
template <int kDegree>
FootSearch searchFoot(const SpanCurve& curve, const Vec2& point, SpanPlace start, double enough, bool isDownhill) {
  constexpr double kShorter = 0.25;  // of a move that leads farther off
  const SpanBasis& basis = curve.basis();
  const std::size_t p = kDegree == Eigen::Dynamic ? basis.degree() : kDegree;
  const int mostSteps = isDownhill ? 40 : 8;  // shortened ones too
  FootSearch search{.place = start};
  SpanPlace best = start;
  double move = 0.0, least = std::numeric_limits<double>::infinity();
  bool isShortened = false;
  for (int step = 0; step < mostSteps; ++step) {
    const double width = basis.width(search.place.span);
    const auto jet = taylorAt<2>(curve.coefficients(search.place.span), p, search.place.tau, 1.0 / width);
    search.end = (jet[0] - point).squaredNorm();
    if (step == 0) search.begin = search.end;
    if (search.end <= enough) {
      search.isSettled = true;
      return search;
    }
    if (!isDownhill || search.end <= least || (!isShortened && std::abs(move) < kSurelyNear)) {
      best = search.place;
      least = search.end;
      isShortened = false;
      move = footStep(jet[0] - point, jet[1], jet[2]) / width;
      move = std::clamp(move, -1.0, 1.0);
    } else {
      move *= kShorter;
      isShortened = true;
    }
    search.place = movedAlong(basis, best, move);
    search.isSettled =
        std::abs(move) < 1e-10 || (search.place.span == best.span && std::abs(search.place.tau - best.tau) < 1e-12);
    if (search.isSettled) return search;
  }
  if (isDownhill) search.place = best;
  return search;
}

template <int kDegree>
SpanPlace footPointOf(const SpanCurve& curve, const Vec2& point, SpanPlace start, double enough) {
  const FootSearch search = searchFoot<kDegree>(curve, point, start, enough, false);
  const SpanPlace& foot = search.place;
  const bool isThere = foot.span == start.span && std::abs(foot.tau - start.tau) < kSurelyNear;
  if (search.isSettled && (isThere || search.end <= search.begin)) return foot;
  return searchFoot<kDegree>(curve, point, start, enough, true).place;
}

}  // namespace

SpanBasis::SpanBasis(int degree, std::span<const double> knots, int count, int wrap)
    : degree_(degree), count_(count), wrap_(wrap) {
  const std::size_t p = degree, size = p + 1;
  for (int k = degree; k < count; ++k) {
    const double a = knots[k], h = knots[k + 1] - a;
    if (!(h > 0.0)) continue;
    breaks_.push_back(a);
    first_.push_back(k - degree);
    // Cox-de Boor on polynomials in tau = (t - a) / h; n[j][i] = coefficient of tau^i of the j-th function alive in the
    // span.
    using Functions = std::array<std::array<double, kMaxDegree + 1>, kMaxDegree + 1>;
    Functions n{};
    n[0][0] = 1.0;
    for (std::size_t m = 1; m <= p; ++m) {
      Functions next{};
      for (std::size_t j = 0; j < m; ++j) {
        const double left = knots[k - m + 1 + j], right = knots[k + 1 + j];
        const double scale = 1.0 / (right - left);
        for (std::size_t i = 0; i < m; ++i) {
          const double v = n[j][i] * scale;
          next[j + 1][i] += v * (a - left);
          next[j + 1][i + 1] += v * h;
          next[j][i] += v * (right - a);
          next[j][i + 1] -= v * h;
        }
      }
      n = next;
    }
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) coefficients_.push_back(n[j][i]);
    }
  }
  breaks_.push_back(knots[count]);
}

SpanPlace SpanBasis::place(double u) const {
  const double inside = std::clamp(u, breaks_.front(), breaks_.back());
  const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, inside);
  const int span = static_cast<int>(above - breaks_.begin()) - 1;
  return {span, (inside - begin(span)) / width(span)};
}

SpanRow SpanBasis::row(const SpanPlace& place, int order) const {
  constexpr int kQuintic = 5;  // the usual case, with loops of known lengths
  const double* c = &coefficients_[place.span * stride() * stride()];
  const int highest = std::min(order, degree_);
  return degree_ == kQuintic ? rowOf<kQuintic>(c, degree_, place.tau, width(place.span), highest)
                             : rowOf<Eigen::Dynamic>(c, degree_, place.tau, width(place.span), highest);
}

SpanCurve::SpanCurve(const SpanBasis& basis, std::span<const Vec2> points) : basis_(&basis) {
  const int p = basis.degree();
  coefficients_.assign(std::ptrdiff_t{basis.spanCount()} * (p + 1), Vec2::Zero());
  for (int s = 0; s < basis.spanCount(); ++s) {
    // The functions add up to 1, so points may be taken from one of their own: far from the origin that saves digits.
    const Vec2& origin = points[basis.point(s, 0)];
    for (int k = 0; k <= p; ++k) {
      Vec2& c = coefficients_[std::ptrdiff_t{s} * (p + 1) + k];
      if (k == 0) c = origin;
      for (int j = 1; j <= p; ++j) {
        c += basis.coefficient(s, k, j) * (points[basis.point(s, j)] - origin);
      }
    }
  }
}

Jet SpanCurve::at(const SpanPlace& place, int order) const {
  const std::size_t p = basis_->degree();
  const Vec2* c = &coefficients_[place.span * (p + 1)];
  const double inverse = 1.0 / basis_->width(place.span);
  switch (order) {
    case 0:
      return jetAt<0>(c, p, place.tau, inverse);
    case 1:
      return jetAt<1>(c, p, place.tau, inverse);
    case 2:
      return jetAt<2>(c, p, place.tau, inverse);
    case 3:
      return jetAt<3>(c, p, place.tau, inverse);
    default:
      return jetAt<4>(c, p, place.tau, inverse);
  }
}

double SpanCurve::speed(const SpanPlace& place) const {
  const std::size_t p = basis_->degree();
  const Vec2* c = &coefficients_[place.span * (p + 1)];
  Vec2 sum = static_cast<double>(p) * c[p];
  for (std::size_t k = p - 1; k >= 1; --k) sum = sum * place.tau + static_cast<double>(k) * c[k];
  return sum.norm() / basis_->width(place.span);
}

SpanCurve::SpeedRange SpanCurve::speedRange(int span, int parts) const {
  SpeedRange range{std::numeric_limits<double>::infinity(), 0.0};
  for (int i = 0; i <= parts; ++i) {
    const double here = speed({span, static_cast<double>(i) / parts});
    range = {std::min(range.least, here), std::max(range.most, here)};
  }
  return range;
}

double SpanCurve::bendBound(int span) const {
  const std::size_t p = basis_->degree(), first = span * (p + 1);
  double bound = 0.0;
  for (std::size_t k = 2; k <= p; ++k) bound += static_cast<double>(k * (k - 1)) * coefficients_[first + k].norm();
  return bound;
}

double SpanCurve::bendBound(const SpanCurve& other, int span) const {
  const std::size_t p = basis_->degree(), first = span * (p + 1);
  double bound = 0.0;
  for (std::size_t k = 2; k <= p; ++k) {
    bound += static_cast<double>(k * (k - 1)) * (coefficients_[first + k] - other.coefficients_[first + k]).norm();
  }
  return bound;
}

std::optional<EqualArc> equalArcPlaces(const SpanCurve& curve, int count, bool closed, CancelCheck check) {
  const int parts = curve.basis().spanCount() * kPartsPerSpan;
  std::vector<PartLength> lengths;
  lengths.reserve(parts);
  std::vector<double> cumulative{0.0};
  for (int k = 0; k < parts; ++k) {
    if (check.isCancelled()) return std::nullopt;
    lengths.emplace_back(curve, k);
    cumulative.push_back(cumulative.back() + lengths.back().whole());
  }
  EqualArc result;
  result.length = cumulative.back();
  if (!(result.length > 0.0) || !std::isfinite(result.length)) return std::nullopt;
  result.places.reserve(count);
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    if (check.isCancelled()) return std::nullopt;
    const double target = result.length * i / (closed ? count : count - 1);
    while (k + 1 < lengths.size() && cumulative[k + 1] <= target) ++k;
    const int part = static_cast<int>(k);
    const double x = i == 0 ? 0.0 : lengths[k].placeAt(target - cumulative[k], cumulative[k + 1] - cumulative[k]);
    result.places.push_back({part / kPartsPerSpan, PartLength::lowOf(part) + x / kPartsPerSpan});
  }
  if (!closed) result.places.back() = {curve.basis().spanCount() - 1, 1.0};
  return result;
}

SpanPlace footPoint(const SpanCurve& curve, const Vec2& point, SpanPlace start, double enough) {
  constexpr int kQuintic = 5;  // the usual case, with loops of known lengths
  const double squared = enough * enough;
  return curve.basis().degree() == kQuintic ? footPointOf<kQuintic>(curve, point, start, squared)
                                            : footPointOf<Eigen::Dynamic>(curve, point, start, squared);
}

}  // namespace batten
