// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/knot_operations.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/curve/blossom.h"
#include "core/curve/nurbs_curve.h"

namespace batten {

namespace {

/// A curve taken apart: control points (w x, w y, w).
struct Parts {
  int degree = 1;
  std::vector<double> knots;
  std::vector<Eigen::Vector3d> points;
  bool rational = false;

  int count() const { return static_cast<int>(points.size()); }
  double knot(int i) const { return knots[i]; }
};

Parts takeApart(const NurbsCurve& curve) {
  Parts parts{curve.degree(), {curve.knots().begin(), curve.knots().end()}, {}, curve.isRational()};
  parts.points.reserve(curve.controlPoints().size());
  for (std::size_t i = 0; i < curve.controlPoints().size(); ++i) {
    const double w = parts.rational ? curve.weights()[i] : 1.0;
    const Vec2& p = curve.controlPoints()[i];
    parts.points.emplace_back(w * p.x(), w * p.y(), w);
  }
  return parts;
}

Result<NurbsCurve> assemble(Parts parts) {
  std::vector<Vec2> points;
  std::vector<double> weights;
  points.reserve(parts.points.size());
  for (const auto& p : parts.points) {
    points.emplace_back(parts.rational ? Vec2(p.head<2>() / p.z()) : Vec2(p.head<2>()));
    if (parts.rational) weights.push_back(p.z());
  }
  return NurbsCurve::make(parts.degree, std::move(parts.knots), std::move(points), std::move(weights));
}

Eigen::Vector3d blossomOf(const Parts& parts, int span, const double* arguments) {
  return blossom(
      parts.degree, [&](int i) { return parts.knots[i]; }, [&](int i) { return parts.points[i]; }, span, arguments);
}

int spanAt(const Parts& parts, double u) { return spanOf(parts.degree, parts.knots, parts.count(), u); }

/// Span of the old curve to take control point j of a new knot vector from: the middle of its support, where the polar
/// form needs to reach least far.
int sourceSpan(const Parts& parts, const std::vector<double>& knots, int degree, int j) {
  const int count = static_cast<int>(knots.size()) - degree - 1;
  std::optional<int> best;
  for (int k = std::max(degree, j - degree); k < std::min(count, j + 2 * degree + 1); ++k) {
    if (!(knots[k] < knots[k + 1])) continue;
    const auto distance = [&](int span) {
      const int outside = std::max({0, j - span, span - j - degree});
      return 100 * outside + std::abs(2 * (span - j) - degree);
    };
    if (!best || distance(k) < distance(*best)) best = k;
  }
  if (!best) return spanAt(parts, knots[std::clamp(j, degree, count - 1)]);
  return spanAt(parts, 0.5 * (knots[*best] + knots[*best + 1]));
}

/// The same curve over a knot vector that contains the old knots (within the domain).
Parts overKnots(const Parts& old, std::vector<double> knots) {
  const int p = old.degree;
  Parts result{p, std::move(knots), {}, old.rational};
  const int count = static_cast<int>(result.knots.size()) - p - 1;
  int follow = 0;  // Control points that keep all their knots are copied, bit for bit.
  for (int j = 0; j < count; ++j) {
    const auto own = result.knots.begin() + j;
    while (follow < old.count() && old.knot(follow) < *own) ++follow;
    std::optional<int> same;
    for (int i = follow; i < old.count() && old.knot(i) == *own && !same; ++i) {
      if (std::equal(own, own + p + 2, old.knots.begin() + i)) same = i;
    }
    if (same) {
      result.points.push_back(old.points[*same]);
    } else {
      result.points.push_back(blossomOf(old, sourceSpan(old, result.knots, p, j), &result.knots[j + 1]));
    }
  }
  return result;
}

bool isClamped(const Parts& parts) {
  return parts.knots[0] == parts.knot(parts.degree) && parts.knots.back() == parts.knot(parts.count());
}

Parts clampedParts(const Parts& parts) {
  if (isClamped(parts)) return parts;
  const double start = parts.knot(parts.degree), end = parts.knot(parts.count());
  const std::size_t order = parts.degree + 1;
  std::vector<double> knots(order, start);
  for (const double k : parts.knots) {
    if (k > start && k < end) knots.push_back(k);
  }
  knots.insert(knots.end(), order, end);
  return overKnots(parts, std::move(knots));
}

/// u, or the knot it lies on but for rounding.
double snapped(const Parts& parts, double u) {
  const double close = 1e-13 * (parts.knot(parts.count()) - parts.knot(parts.degree));
  for (const double k : parts.knots) {
    if (std::abs(k - u) <= close) return k;
  }
  return u;
}

int multiplicity(const Parts& parts, double u) {
  const auto [first, last] = std::equal_range(parts.knots.begin(), parts.knots.end(), u);
  return static_cast<int>(last - first);
}

Parts elevatedOnce(const Parts& old) {
  const int p = old.degree, q = p + 1;
  Parts result{q, {}, {}, old.rational};
  for (std::size_t i = 0; i < old.knots.size(); ++i) {
    if (i == 0 || old.knots[i] != old.knots[i - 1]) result.knots.push_back(old.knots[i]);
    result.knots.push_back(old.knots[i]);
  }
  const int count = static_cast<int>(result.knots.size()) - q - 1;
  for (int j = 0; j < count; ++j) {
    // The polar form of degree q is the mean of those of degree p with one argument left out.
    const int span = sourceSpan(old, result.knots, q, j);
    const double* arguments = &result.knots[j + 1];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int omit = 0; omit < q; ++omit) {
      std::array<double, 8> rest{};
      for (int i = 0, k = 0; i < q; ++i) {
        if (i != omit) rest[k++] = arguments[i];
      }
      sum += blossomOf(old, span, rest.data());
    }
    result.points.push_back(sum / q);
  }
  return result;
}

}  // namespace

Result<NurbsCurve> insertKnot(const NurbsCurve& curve, double u, int times) {
  const Parts parts = takeApart(curve);
  if (times < 0 || !(u >= curve.start() && u <= curve.end())) {
    return fail(ErrorCode::BadParameter, "A knot can only be inserted within the domain of the curve.");
  }
  const double at = snapped(parts, u);
  const bool isEnd = at == curve.start() || at == curve.end();
  if (multiplicity(parts, at) + times > curve.degree() + (isEnd ? 1 : 0)) {
    return fail(ErrorCode::BadParameter, "The knot would be repeated more often than the degree of the curve.");
  }
  if (times == 0) return curve;
  std::vector<double> knots = parts.knots;
  knots.insert(std::upper_bound(knots.begin(), knots.end(), at), times, at);
  return assemble(overKnots(parts, std::move(knots)));
}

Result<NurbsCurve> clamped(const NurbsCurve& curve) { return assemble(clampedParts(takeApart(curve))); }

Result<SplitCurve> split(const NurbsCurve& curve, double u) {
  Parts parts = clampedParts(takeApart(curve));
  const double at = snapped(parts, u);
  if (!(at > curve.start() && at < curve.end())) {
    return fail(ErrorCode::BadParameter, "A curve can only be cut strictly inside its domain.");
  }
  const int p = parts.degree;
  const int missing = std::max(0, p - multiplicity(parts, at));
  std::vector<double> knots = parts.knots;
  knots.insert(std::upper_bound(knots.begin(), knots.end(), at), missing, at);
  parts = overKnots(parts, std::move(knots));
  const auto [first, last] = std::equal_range(parts.knots.begin(), parts.knots.end(), at);
  const std::size_t order = p + 1;

  Parts left{p, {parts.knots.begin(), first}, {}, parts.rational};
  left.knots.insert(left.knots.end(), order, at);
  left.points.assign(parts.points.begin(), parts.points.begin() + (first - parts.knots.begin()));
  Parts right{p, std::vector<double>(order, at), {}, parts.rational};
  right.knots.insert(right.knots.end(), last, parts.knots.end());
  right.points.assign(parts.points.begin() + (last - parts.knots.begin()) - p - 1, parts.points.end());

  auto leftCurve = assemble(std::move(left));
  if (!leftCurve) return fail(leftCurve.error());
  auto rightCurve = assemble(std::move(right));
  if (!rightCurve) return fail(rightCurve.error());
  return SplitCurve{std::move(*leftCurve), std::move(*rightCurve)};
}

Result<std::vector<NurbsCurve>> splitAtAll(const NurbsCurve& curve, std::span<const double> places) {
  if (places.empty()) return std::vector<NurbsCurve>{curve};
  // By halves: to cut off one part after the other copies the rest each time.
  const std::size_t middle = places.size() / 2;
  const auto halves = split(curve, places[middle]);
  if (!halves) return fail(halves.error());
  auto parts = splitAtAll(halves->left, places.first(middle));
  if (!parts) return parts;
  auto behind = splitAtAll(halves->right, places.subspan(middle + 1));
  if (!behind) return behind;
  std::move(behind->begin(), behind->end(), std::back_inserter(*parts));
  return parts;
}

Result<NurbsCurve> joinAtCorners(std::span<const NurbsCurve> pieces, double tolerance) {
  if (pieces.empty()) return fail(ErrorCode::BadParameter, "There is no curve to join.");
  Parts joined = clampedParts(takeApart(pieces.front()));
  for (const NurbsCurve& piece : pieces.subspan(1)) {
    Parts next = clampedParts(takeApart(piece));
    if (next.degree != joined.degree) return fail(ErrorCode::BadParameter, "Only curves of one degree can be joined.");
    // A rational piece may be scaled as a whole: the weights at the joint are made equal.
    const double scale = joined.points.back().z() / next.points.front().z();
    for (auto& p : next.points) p *= scale;
    joined.rational = joined.rational || next.rational;
    Eigen::Vector3d& end = joined.points.back();
    const double weight = end.z();
    if (!((end - next.points.front()).norm() <= tolerance * weight)) {
      return fail(ErrorCode::BadParameter, "The curves to join do not meet end to end.");
    }
    end = 0.5 * (end + next.points.front());
    end.z() = weight;
    const double shift = joined.knots.back() - next.knots.front();
    joined.knots.pop_back();
    for (auto k = next.knots.begin() + next.degree + 1; k != next.knots.end(); ++k) joined.knots.push_back(*k + shift);
    joined.points.insert(joined.points.end(), next.points.begin() + 1, next.points.end());
  }
  return assemble(std::move(joined));
}

void removeExactKnot(int degree, std::vector<double>& knots, std::vector<Vec2>& points, KnotRun run) {
  const int r = run.last, s = run.multiplicity;
  const double u = knots[r];
  int i = r - degree, j = r - s;
  Vec2 left = points[i - 1], right = points[j + 1];
  while (j > i) {
    const double a = (u - knots[i]) / (knots[i + degree + 1] - knots[i]);
    const double b = (u - knots[j]) / (knots[j + degree + 1] - knots[j]);
    left = (points[i] - (1.0 - a) * left) / a;
    right = (points[j] - b * right) / (1.0 - b);
    points[i++] = left;
    points[j--] = right;
  }
  if (j < i && s == degree - 1) points[r - degree] = points[r - s] = 0.5 * (points[r - degree] + points[r - s]);
  points.erase(points.begin() + (2 * r - s - degree) / 2);
  knots.erase(knots.begin() + r);
}

Result<NurbsCurve> elevated(const NurbsCurve& curve, int degree) {
  if (degree < curve.degree() || degree > 7) {
    return fail(ErrorCode::BadParameter, "The degree of a curve can only be raised, up to 7.");
  }
  if (degree == curve.degree()) return curve;
  Parts parts = clampedParts(takeApart(curve));
  while (parts.degree < degree) parts = elevatedOnce(parts);
  return assemble(std::move(parts));
}

NurbsCurve reversed(const NurbsCurve& curve) {
  const double sum = curve.start() + curve.end();
  std::vector<double> knots(curve.knots().rbegin(), curve.knots().rend());
  for (double& k : knots) {
    // The borders of the domain change places exactly; rounding must not move them.
    k = k == curve.start() ? curve.end() : k == curve.end() ? curve.start() : sum - k;
  }
  // A valid curve stays valid but for knots that rounding of `sum - k` could swap.
  for (std::size_t i = 1; i < knots.size(); ++i) knots[i] = std::max(knots[i], knots[i - 1]);
  auto result =
      NurbsCurve::make(curve.degree(), std::move(knots), {curve.controlPoints().rbegin(), curve.controlPoints().rend()},
                       {curve.weights().rbegin(), curve.weights().rend()});
  if (!result) return curve;
  return std::move(*result);
}

Result<NurbsCurve> reparametrized(const NurbsCurve& curve, double start, double end) {
  if (!(end > start) || !std::isfinite(end - start)) {
    return fail(ErrorCode::BadParameter, "The new domain of the curve must have a length.");
  }
  const double scale = (end - start) / (curve.end() - curve.start());
  std::vector<double> knots(curve.knots().begin(), curve.knots().end());
  for (double& k : knots) {
    k = k == curve.start() ? start : k == curve.end() ? end : start + (k - curve.start()) * scale;
  }
  for (std::size_t i = 1; i < knots.size(); ++i) knots[i] = std::max(knots[i], knots[i - 1]);
  return NurbsCurve::make(curve.degree(), std::move(knots),
                          {curve.controlPoints().begin(), curve.controlPoints().end()},
                          {curve.weights().begin(), curve.weights().end()});
}

Result<std::vector<BezierPiece>> bezierPieces(const NurbsCurve& curve) {
  if (curve.isRational()) {
    return fail(ErrorCode::BadParameter, "A rational curve cannot be cut into polynomial pieces.");
  }
  const Parts parts = takeApart(curve);
  const int p = parts.degree;
  std::vector<BezierPiece> pieces;
  for (int span = p; span < parts.count(); ++span) {
    const double low = parts.knot(span), high = parts.knot(span + 1);
    if (!(low < high)) continue;
    BezierPiece piece{low, high, {}};
    for (int j = 0; j <= p; ++j) {
      std::array<double, 8> arguments{};
      for (int i = 0; i < p; ++i) arguments[i] = i < p - j ? low : high;
      piece.controlPoints.emplace_back(blossomOf(parts, span, arguments.data()).head<2>());
    }
    if (!pieces.empty() && multiplicity(parts, low) <= p)
      piece.controlPoints.front() = pieces.back().controlPoints.back();
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace batten
