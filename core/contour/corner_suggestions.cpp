// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "core/contour/corner_geometry.h"
#include "core/contour/corner_marks.h"
#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

struct Candidate {
  int index;
  double angle, score, s;
};

// The angle between the chords on either side: cheap, and never much smaller than the angle of a corner.
double chordAngle(const Contour& contour, int i, int reach) {
  const int n = static_cast<int>(contour.points.size());
  const int a = contour.closed ? wrapIndex(i - reach, n) : i - reach;
  const int b = contour.closed ? wrapIndex(i + reach, n) : i + reach;
  if (a < 0 || b >= n) return 0.0;
  const Vec2 in = contour.points[static_cast<std::size_t>(i)] - contour.points[static_cast<std::size_t>(a)];
  const Vec2 out = contour.points[static_cast<std::size_t>(b)] - contour.points[static_cast<std::size_t>(i)];
  return std::abs(std::atan2(cross(in, out), in.dot(out)));
}

// [px] How rough the line is about every point: the median over 300 px of what parabolas of one scale leave over.
std::vector<double> roughnessOf(const Contour& contour, double scale) {
  constexpr int kStride = 6, kWindow = 25;
  const int n = static_cast<int>(contour.points.size());
  std::vector<double> residual;
  for (int i = 0; i < n; i += kStride) {
    const OneSidedFit fit = fitOneSide(contour, i, 1, 0.0, scale);
    residual.push_back(fit.reach > 0.5 * scale ? fit.fit.residualRms : 0.0);
  }
  std::vector<double> rough(static_cast<std::size_t>(n)), window;
  const int count = static_cast<int>(residual.size());
  for (int k = 0; k < count; ++k) {
    window.clear();
    for (int j = -kWindow; j <= kWindow; ++j) {
      if (!contour.closed && (k + j < 0 || k + j >= count)) continue;
      window.push_back(residual[static_cast<std::size_t>(wrapIndex(k + j, count))]);
    }
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
    std::nth_element(window.begin(), middle, window.end());
    for (int i = k * kStride; i < std::min(n, (k + 1) * kStride); ++i) rough[static_cast<std::size_t>(i)] = *middle;
  }
  return rough;
}

// [rad] Standard deviation of the angle between two parabolas of length `scale` on such a line, whose dents are about
// `kDentPx` long: the slope at the end of a parabola has variance 192 S / L^3 for noise of density S.
double angleNoise(double roughPx, double scale) {
  constexpr double kDentPx = 8.0;
  return roughPx * std::sqrt(2.0 * 192.0 * kDentPx / (scale * scale * scale));
}

// On a clean line a corner is one however short its legs are. On a rough one it may be a dent, which has gone once more
// of the line is looked at; a corner has not.
bool isMoreThanADent(const Contour& contour, int i, const Turning& turning, double rough, double inner, double scale) {
  constexpr double kCleanScore = 0.75, kSure = 5.0, kCoarser = 3.5, kStays = 0.7;
  const double angle = std::abs(turning.angleRad);
  if (turning.score >= kCleanScore * angle && angle >= kSure * angleNoise(rough, scale)) return true;
  const auto coarse = turningAt(contour, i, inner, inner + kCoarser * scale);
  return coarse && coarse->angleRad * turning.angleRad > 0.0 && std::abs(coarse->angleRad) >= kStays * angle &&
         std::abs(coarse->angleRad) >= kSure * angleNoise(rough, kCoarser * scale);
}

std::vector<Candidate> candidatesOf(const Contour& contour, double minAngle, double scale) {
  std::vector<Candidate> found;
  const int n = static_cast<int>(contour.points.size());
  if (n < 8) return found;
  const std::vector<double> s = cumulativeLength(contour.points);
  const double step = std::max(0.1, s.back() / (n - 1));
  const std::vector<double> rough = roughnessOf(contour, scale);
  const int reach = std::clamp(static_cast<int>(0.6 * scale / step), 2, std::max(2, n / 3));
  for (int i = 0; i < n; ++i) {
    if (chordAngle(contour, i, reach) < 0.6 * minAngle) continue;
    const double inner = contour.kind == ContourKind::Outline ? std::min(3.0, 0.25 * scale) : roundedZonePx(contour, i);
    const auto turning = turningAt(contour, i, inner, inner + scale);
    if (!turning || std::abs(turning->angleRad) < minAngle) continue;
    // The score is the angle discounted by misfit; half of it lost means that the legs are no legs.
    if (turning->score < 0.5 * std::abs(turning->angleRad)) continue;
    if (!isMoreThanADent(contour, i, *turning, rough[static_cast<std::size_t>(i)], inner, scale)) continue;
    found.push_back({i, turning->angleRad, turning->score, s[static_cast<std::size_t>(i)]});
  }
  return found;
}

}  // namespace

std::vector<CornerSuggestion> suggestCorners(const ContourSet& set, double minAngleRad, double scalePx) {
  std::vector<CornerSuggestion> suggestions;
  if (!(minAngleRad > 0.0) || !(scalePx > 0.0)) return suggestions;
  for (std::size_t c = 0; c < set.contours.size(); ++c) {
    const Contour& contour = set.contours[c];
    std::vector<Candidate> candidates = candidatesOf(contour, minAngleRad, scalePx);
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    const double length = polylineLength(contour.points, contour.closed);
    std::vector<Candidate> kept;
    for (const Candidate& candidate : candidates) {
      const bool near = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
        const double d = std::abs(candidate.s - other.s);
        return std::min(d, contour.closed ? length - d : d) < scalePx;
      });
      if (!near) kept.push_back(candidate);
    }
    std::sort(kept.begin(), kept.end(), [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Candidate& k = kept[i];
      const double zone = roundedZonePx(contour, k.index);
      // The legs end at the neighbouring corners.
      const double behind = i > 0 ? k.s - kept[i - 1].s : k.s + (contour.closed ? length - kept.back().s : 0.0);
      const double ahead =
          i + 1 < kept.size() ? kept[i + 1].s - k.s : length - k.s + (contour.closed ? kept.front().s : 0.0);
      const auto outer = [&](double free) {
        return std::clamp((kept.size() > 1 ? free : 0.5 * length) - zone, 0.0, zone + 80.0);
      };
      const CornerFix fix = locateCorner(contour, k.index, zone, outer(behind), outer(ahead));
      suggestions.push_back({static_cast<int>(c), k.index, fix.position, k.angle});
    }
  }
  return suggestions;
}

}  // namespace batten
