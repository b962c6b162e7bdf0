// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/uneven_ink.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kUneven = 0.1,
                 kUnevenBesideOthers = 0.04;       // robust standard deviation of the ink as part of its contrast
constexpr int kPointStep = 2;                      // points, of which the neighbours see the same ink
constexpr int kArmPoints = 3;                      // points to either side: the course of the border
constexpr double kInsidePx[] = {3, 6, 9};          // beyond the blur of the border
constexpr double kOutsidePx = 5.0;                 // as is the paper
constexpr int kFewestInk = 20, kFewestPaper = 10;  // places that tell
constexpr double kQuartilesInSigmas = 1.349;       // from the lower to the upper one of a normal distribution

bool isInk(const BitImage& ink, Vec2 at) {
  const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
  return x >= 0 && y >= 0 && x < ink.width && y < ink.height && ink.at(x, y);
}

// Grey level 0..255, the mean of 3 x 3 pixels; absent: not all of them are ink, or paper, as asked for.
std::optional<double> meanOf(const GreyImage& grey, const BitImage& ink, Vec2 at, bool inside) {
  const int x0 = static_cast<int>(std::floor(at.x())) - 1, y0 = static_cast<int>(std::floor(at.y())) - 1;
  if (x0 < 0 || y0 < 0 || x0 + 3 > grey.width || y0 + 3 > grey.height) return std::nullopt;
  double sum = 0.0;
  for (int y = y0; y < y0 + 3; ++y) {
    for (int x = x0; x < x0 + 3; ++x) {
      if (ink.at(x, y) != inside) return std::nullopt;
      sum += grey.level(x, y);
    }
  }
  return sum / 9.0;
}

// Robust standard deviation of the ink as part of its contrast; absent: too few places tell.
std::optional<double> unevennessOf(const Contour& border, const BitImage& ink, const GreyImage& grey) {
  std::vector<double> inside, outside;
  const int n = static_cast<int>(std::ssize(border.points));
  for (int i = 0; i < n; i += kPointStep) {
    const Vec2 at = border.points[i].unrefined;
    const Vec2 way =
        border.points[(i + kArmPoints) % n].unrefined - border.points[(i + n - kArmPoints % n) % n].unrefined;
    if (!(way.norm() > 0.0)) continue;
    Vec2 inward = leftNormal(way.normalized());
    if (!isInk(ink, at + kInsidePx[0] * inward)) inward = -inward;
    for (const double depth : kInsidePx)
      if (const auto mean = meanOf(grey, ink, at + depth * inward, true)) inside.push_back(*mean);
    if (const auto mean = meanOf(grey, ink, at - kOutsidePx * inward, false)) outside.push_back(*mean);
  }
  if (std::ssize(inside) < kFewestInk || std::ssize(outside) < kFewestPaper) return std::nullopt;
  const double contrast = upperMedian(outside) - upperMedian(inside);
  const std::ptrdiff_t quarter = std::ssize(inside) / 4;
  const double spread =
      (elementOfRank(inside, std::ssize(inside) - 1 - quarter) - elementOfRank(inside, quarter)) / kQuartilesInSigmas;
  return spread / std::max(1.0, std::abs(contrast));
}

}  // namespace

void noteUnevenInk(ContourSet& borders, const BitImage& ink, const GreyImage& grey) {
  std::vector<std::optional<double>> unevenness;
  double uneven = 0.0, all = 0.0;
  for (const Contour& border : borders.contours) {
    unevenness.push_back(unevennessOf(border, ink, grey));
    if (!unevenness.back()) continue;
    all += border.lengthPx;
    if (*unevenness.back() > kUneven) uneven += border.lengthPx;
  }
  const double limit = 2.0 * uneven > all ? kUnevenBesideOthers : kUneven;
  for (std::size_t i = 0; i < borders.contours.size(); ++i) borders.contours[i].isUneven = unevenness[i] > limit;
}

}  // namespace batten
