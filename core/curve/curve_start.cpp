// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/curve_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"

namespace batten {
namespace {

constexpr double kSameStart = 1e-9;     ///< Of the domain.
constexpr double kSeamMeets = 1e-6;     ///< Of the size of the curve: gap at the seam.
constexpr double kRemovedMove = 1e-11;  ///< Of the size of the curve: what taking a knot out may move it.

/// The curve without one of the knots u, if that moves it by no more than `tolerance`: The NURBS Book, section 5.4. The
/// new control points are computed from both sides; where they meet they must agree.
std::optional<NurbsCurve> withoutKnot(const NurbsCurve& curve, double u, double tolerance) {
  const int p = curve.degree();
  std::vector<double> knots(curve.knots().begin(), curve.knots().end());
  std::vector<Vec2> points(curve.controlPoints().begin(), curve.controlPoints().end());
  const auto behind = std::upper_bound(knots.begin(), knots.end(), u);
  const int last = static_cast<int>(behind - knots.begin()) - 1;
  const int repeated = static_cast<int>(behind - std::lower_bound(knots.begin(), knots.end(), u));
  if (repeated == 0) return std::nullopt;
  const auto at = [](auto& list, int i) -> auto& { return list[i]; };
  int i = last - p, j = last - repeated;
  Vec2 left = at(points, i - 1), right = at(points, j + 1);
  std::vector<Vec2> fresh = points;
  const auto share = [&](int k) { return (u - at(knots, k)) / (at(knots, k + p + 1) - at(knots, k)); };
  for (; j > i; ++i, --j) {
    const double fromLeft = share(i), fromRight = share(j);
    left = (at(points, i) - (1.0 - fromLeft) * left) / fromLeft;
    right = (at(points, j) - fromRight * right) / (1.0 - fromRight);
    at(fresh, i) = left;
    at(fresh, j) = right;
  }
  const double miss =
      j < i ? (left - right).norm() : (at(points, i) - (share(i) * right + (1.0 - share(i)) * left)).norm();
  if (!(miss <= tolerance)) return std::nullopt;
  knots.erase(knots.begin() + last);
  fresh.erase(fresh.begin() + (2 * last - repeated - p) / 2);
  auto made = NurbsCurve::make(p, std::move(knots), std::move(fresh));
  return made ? std::optional(std::move(*made)) : std::nullopt;
}

}  // namespace

Result<NurbsCurve> startedAt(const NurbsCurve& closed, double u) {
  const double period = closed.end() - closed.start(), size = extent(closed);
  if (std::min(u - closed.start(), closed.end() - u) <= kSameStart * period) return closed;
  auto whole = clamped(closed);
  if (!whole) return whole;
  auto parts = split(*whole, u);
  if (!parts) return fail(parts.error());
  auto later = reparametrized(parts->left, closed.end(), closed.end() + (u - closed.start()));
  if (!later) return later;
  auto joined = joinAtCorners(std::array{parts->right, *later}, kSeamMeets * size);
  if (!joined || joined->isRational()) return joined;
  // joinAtCorners may shift the parameters: the seam is where the first part ends.
  const double seam = joined->start() + (closed.end() - u);
  const auto breaks = joined->breaks();
  const auto nearest = std::min_element(breaks.begin(), breaks.end(),
                                        [seam](double a, double b) { return std::abs(a - seam) < std::abs(b - seam); });
  const double knot = *nearest;
  // One stays: the seam was a place where two spans met.
  for (int left = closed.degree(); left > 1; --left) {
    auto without = withoutKnot(*joined, knot, kRemovedMove * size);
    if (!without) break;
    joined = std::move(*without);
  }
  return joined;
}

NurbsCurve startedNear(const NurbsCurve& closed, const Vec2& place) {
  auto started = startedAt(closed, closestPoint(closed, place).u);
  if (!started) return closed;
  return std::move(*started);
}

}  // namespace batten
