// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/curvature_shift.h"

#include <algorithm>
#include <cmath>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kBendHalf = 6;       // points: half window of the curvature filter
constexpr int kFewestWindows = 6;  // half windows: what three windows side by side take
constexpr double kTightest = 0.2;  // [1/px] an arc of 5 px is the tightest that the window can tell

double smallestMagnitude(double a, double b, double c) {
  if ((a > 0.0) != (b > 0.0) || (b > 0.0) != (c > 0.0)) return 0.0;
  const double m = std::min({std::abs(a), std::abs(b), std::abs(c)});
  return a > 0.0 ? m : -m;
}

}  // namespace

void undoCurvatureShift(std::vector<Vec2>& points, const std::vector<Vec2>& normal, bool closed, double blur) {
  const int n = static_cast<int>(points.size());
  if (n < kFewestWindows * kBendHalf) return;
  double meanSquare = 0.0, norm = 0.0;
  for (int j = -kBendHalf; j <= kBendHalf; ++j) meanSquare += j * j;
  meanSquare /= 2 * kBendHalf + 1;
  for (int j = -kBendHalf; j <= kBendHalf; ++j) norm += (j * j - meanSquare) * (j * j - meanSquare);
  const auto at = [&](int i) { return closed ? wrapIndex(i, n) : std::clamp(i, 0, n - 1); };
  std::vector<Vec2> bend(points.size());
  for (int i = 0; i < n; ++i) {
    Vec2 sum = Vec2::Zero();
    for (int j = -kBendHalf; j <= kBendHalf; ++j) sum += (j * j - meanSquare) * points[at(i + j)];
    const double chord = (points[at(i + kBendHalf)] - points[at(i - kBendHalf)]).norm() / (2 * kBendHalf);
    bend[at(i)] = chord > 0.0 ? Vec2(2.0 * sum / (norm * chord * chord)) : Vec2(Vec2::Zero());
  }
  std::vector<double> shift(points.size());
  for (int i = 0; i < n; ++i) {
    const Vec2& unit = normal[at(i)];
    const double kappa =
        smallestMagnitude(bend[at(i)].dot(unit), bend[at(i - kBendHalf)].dot(normal[at(i - kBendHalf)]),
                          bend[at(i + kBendHalf)].dot(normal[at(i + kBendHalf)]));
    shift[at(i)] = -0.5 * blur * blur * std::clamp(kappa, -kTightest, kTightest);
  }
  for (int i = 0; i < n; ++i) points[at(i)] += shift[at(i)] * normal[at(i)];
}

}  // namespace batten
