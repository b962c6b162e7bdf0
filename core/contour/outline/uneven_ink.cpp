// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/uneven_ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

// Robust standard deviation of the ink as part of its contrast. Drawn solids have 0 to .08, brushes .1 to .3, pencil
// tone .3 to .8.
constexpr double kUnevenBorder = 0.1;
constexpr double kUnevenBesideOthers = 0.04;                   // where most are uneven
constexpr int kPointStep = 3;                                  // points, of which the neighbours see the same ink
constexpr int kArmPoints = 3;                                  // points to either side: the course of the border
constexpr double kInsidePx[] = {3, 6, 9};                      // from the border
constexpr double kOutsidePx = 5.0;                             // as is the paper
constexpr int kFewestInkPlaces = 20, kFewestPaperPlaces = 10;  // places that tell
constexpr double kQuartilesInSigmas = 1.349;  // from the lower to the upper one of a normal distribution

bool isInk(const BitImage& ink, Vec2 at) {
  return ink.at(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
}

// Grey level 0..255, the mean of 3 x 3 pixels; absent: not all of them are ink, or paper, as asked for.
std::optional<double> meanOfNine(const GreyImage& grey, const BitImage& ink, Vec2 at, bool inside) {
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

// Grey levels at places just inside a border, by depth, and just outside.
struct BorderLevels {
  std::array<std::vector<double>, std::size(kInsidePx)> inside;
  std::vector<double> outside;
};

BorderLevels levelsAt(const Contour& border, const BitImage& ink, const GreyImage& grey) {
  BorderLevels levels;
  const int n = static_cast<int>(std::ssize(border.points));
  for (int i = 0; i < n; i += kPointStep) {
    const Vec2 at = border.points[i].unrefined;
    const Vec2 way =
        border.points[(i + kArmPoints) % n].unrefined - border.points[(i + n - kArmPoints % n) % n].unrefined;
    if (!(way.norm() > 0.0)) continue;
    Vec2 inward = leftNormal(way.normalized());
    if (!isInk(ink, at + kInsidePx[0] * inward)) inward = -inward;
    for (std::size_t d = 0; d < std::size(kInsidePx); ++d)
      if (const auto mean = meanOfNine(grey, ink, at + kInsidePx[d] * inward, true)) levels.inside[d].push_back(*mean);
    if (const auto mean = meanOfNine(grey, ink, at - kOutsidePx * inward, false)) levels.outside.push_back(*mean);
  }
  return levels;
}

// Robust standard deviation of the ink as part of its contrast; absent: too few places tell. What the blur of the
// border does changes with the depth alone.
std::optional<double> unevennessOfBorder(const Contour& border, const BitImage& ink, const GreyImage& grey) {
  BorderLevels levels = levelsAt(border, ink, grey);
  std::vector<double> spread;
  double darkest = 255.0;
  for (std::vector<double>& ofDepth : levels.inside) {
    if (ofDepth.empty()) continue;
    const double middle = upperMedian(ofDepth);
    darkest = std::min(darkest, middle);
    for (const double level : ofDepth) spread.push_back(level - middle);
  }
  if (std::ssize(spread) < kFewestInkPlaces || std::ssize(levels.outside) < kFewestPaperPlaces) return std::nullopt;
  const double contrast = std::max(1.0, std::abs(upperMedian(levels.outside) - darkest));
  const std::ptrdiff_t quarter = std::ssize(spread) / 4;
  const double quartiles = elementOfRank(spread, std::ssize(spread) - 1 - quarter) - elementOfRank(spread, quarter);
  return quartiles / kQuartilesInSigmas / contrast;
}

}  // namespace

void noteUnevenInk(ContourSet& borders, const BitImage& ink, const GreyImage& grey, const RunContext& context) {
  const int count = static_cast<int>(std::ssize(borders.contours));
  std::vector<std::optional<double>> unevenness(count);
  parallelFor(context, count, 1, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i)
      unevenness[i] = unevennessOfBorder(borders.contours[i], ink, grey);
  });
  if (context.isCancelled()) return;
  double uneven = 0.0, all = 0.0;
  for (int i = 0; i < count; ++i) {
    if (!unevenness[i]) continue;
    all += borders.contours[i].lengthPx;
    if (*unevenness[i] > kUnevenBorder) uneven += borders.contours[i].lengthPx;
  }
  const double limit = 2.0 * uneven > all ? kUnevenBesideOthers : kUnevenBorder;
  for (int i = 0; i < count; ++i) borders.contours[i].isUneven = unevenness[i] > limit;
}

}  // namespace batten
