// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/curve/curvature.h"

namespace batten {
namespace {

constexpr double kLeastSpeed = 0.1;  // of the mean
constexpr double kFootOff = 2.0;     // samples of the dense curve by which a foot may be off
constexpr double kJump = 3.0;        // steps of the curve that its foot may run on at once, and two samples

struct CheckedPlace {
  Vec2 point;
  double speed;
};

std::vector<CheckedPlace> placesOf(const NurbsCurve& curve, bool closed) {
  const std::vector<double> breaks = curve.breaks();
  const int spans = static_cast<int>(breaks.size()) - 1;
  const int perSpan = checkedPlacesPerSpan(spans);
  std::vector<CheckedPlace> places;
  places.reserve(perSpan * spans + 1);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 0; k < perSpan; ++k) {
      const auto d = curve.derivatives(breaks[i] + (breaks[i + 1] - breaks[i]) * k / perSpan, 1);
      places.push_back({d[0], d[1].norm()});
    }
  }
  if (!closed) {
    const auto d = curve.derivatives(curve.end(), 1);
    places.push_back({d[0], d[1].norm()});
  }
  return places;
}

/// Arc length from one sample to another, forwards; around the seam the short way.
double advance(const LightReference& reference, int from, int to) {
  double length = reference.at(to).s - reference.at(from).s;
  if (!reference.isClosed()) return length;
  if (length > 0.5 * reference.length()) length -= reference.length();
  if (length < -0.5 * reference.length()) length += reference.length();
  return length;
}

/// Largest offset, or none when the feet do not run over all of the reference in order.
std::optional<double> worstOffset(const std::vector<CheckedPlace>& places, const LightReference& reference,
                                  double tolerance) {
  const double spacing = reference.length() / reference.size();
  int index = 0;
  if (reference.isClosed()) {
    double best = (reference.at(0).point - places.front().point).squaredNorm();
    for (int i = 1; i < reference.size(); ++i) {
      const double squared = (reference.at(i).point - places.front().point).squaredNorm();
      if (squared < best) {
        best = squared;
        index = i;
      }
    }
  }
  double worst = 0.0, run = 0.0;
  const LightFoot first = reference.foot(places.front().point, index);
  int last = first.index;
  for (std::size_t k = 0; k < places.size() + (reference.isClosed() ? 1 : 0); ++k) {
    const CheckedPlace& place = places[k % places.size()];
    const LightFoot foot = reference.foot(place.point, last);
    worst = std::max(worst, std::hypot(foot.offset, std::max(0.0, std::abs(foot.along) - spacing)));
    if (worst > tolerance) return worst;
    const double moved = advance(reference, last, foot.index);
    const double step = k == 0 ? 0.0 : (place.point - places[k - 1].point).norm();
    if (moved < -kFootOff * spacing || moved > kJump * step + kFootOff * spacing + tolerance) return std::nullopt;
    run += moved;
    last = foot.index;
  }
  const bool all = reference.isClosed() ? std::abs(run - reference.length()) < 2.0 * kFootOff * spacing
                                        : first.index <= 1 && last >= reference.size() - 2;
  return all ? std::optional(worst) : std::nullopt;
}

}  // namespace

int checkedPlacesPerSpan(int spans) {
  constexpr int kFewestPlaces = 400, kPerSpan = 40;  // of the curve, and of a span
  return std::max(kPerSpan, (kFewestPlaces + spans - 1) / spans);
}

double lightProminence(const LightReference& reference) { return kExtremumProminence / reference.diagonal(); }

LightVerdict checkLight(const NurbsCurve& curve, const LightReference& reference, const LightBounds& bounds) {
  LightVerdict verdict;
  const bool closed = reference.isClosed();
  const std::vector<CheckedPlace> places = placesOf(curve, closed);
  double mean = 0.0;
  for (const CheckedPlace& place : places) mean += place.speed / static_cast<double>(places.size());
  const auto slowest = std::min_element(places.begin(), places.end(),
                                        [](const CheckedPlace& a, const CheckedPlace& b) { return a.speed < b.speed; });
  if (!(slowest->speed > kLeastSpeed * mean)) return verdict;
  const auto worst = worstOffset(places, reference, bounds.tolerance);
  if (!worst) return verdict;
  verdict.worst = *worst;
  if (*worst > bounds.tolerance) return verdict;
  const double prominence = kExtremumProminence / std::max(extent(curve), reference.diagonal());
  const CurvatureCounts counts = curvatureCounts(curve, prominence, closed);
  verdict.extrema = counts.extrema;
  verdict.inflections = counts.inflections;
  verdict.holds = verdict.extrema <= bounds.extrema && verdict.inflections <= bounds.inflections;
  return verdict;
}

}  // namespace batten
