// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/curvature.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/curve/arc_length.h"
#include "core/curve/extremum_indices.h"
#include "core/curve/span_polynomials.h"

namespace batten {

namespace {

using Derivatives = std::array<Vec2, 5>;

/// The direction of travel is lost where |R'| is no more than rounding noise of the position or vanishes beside R''.
bool hasDirection(const Derivatives& d, double domain) {
  const double moved = d[1].norm() * domain;
  return moved > 1e-13 * (d[0].norm() + d[2].norm() * domain * domain) && moved > 0.0;
}

std::optional<double> curvatureOf(const Derivatives& d, double domain) {
  if (!hasDirection(d, domain)) return std::nullopt;
  const double v = d[1].norm();
  const double kappa = cross(d[1] / v, d[2] / v) / v;
  return std::isfinite(kappa) ? std::optional(kappa) : std::nullopt;
}

std::optional<double> slopeOf(const Derivatives& d, double domain) {
  const auto kappa = curvatureOf(d, domain);
  if (!kappa) return std::nullopt;
  const double v = d[1].norm();
  const Vec2 t = d[1] / v;
  const double slope = cross(t, d[3] / v) / (v * v) - 3.0 * *kappa * t.dot(d[2] / v) / v;
  return std::isfinite(slope) ? std::optional(slope) : std::nullopt;
}

/// Curvature along the curve, dense enough that between two neighbours it is monotone but for bumps too small to
/// matter.
struct Profile {
  struct Point {
    double u, kappa;
  };
  std::vector<Point> points;

  Profile(const NurbsCurve& curve, CancelCheck check) : spans_(curve), domain_(curve.end() - curve.start()) {
    const std::vector<double> breaks = curve.breaks();
    // Inside a span everything is smooth; the limits from both sides of a knot are taken just beside it.
    for (std::size_t i = 0; i + 1 < breaks.size() && !check.isCancelled(); ++i) {
      const double width = breaks[i + 1] - breaks[i];
      const double from = breaks[i], to = i + 2 == breaks.size() ? breaks[i + 1] : breaks[i + 1] - 1e-9 * width;
      constexpr int kPerSpan = 24;  // steps, of which connect() halves those that are too long
      Sample last = sampleAt(from);
      push(last);
      for (int k = 1; k <= kPerSpan; ++k) {
        const Sample next = sampleAt(from + (to - from) * k / kPerSpan);
        connect(last, next, 0);
        last = next;
      }
    }
  }

 private:
  struct Sample {
    double u;
    Derivatives d;
    std::optional<double> kappa, slope;
  };
  Sample sampleAt(double u) const {
    Sample sample{u, spans_.derivatives(u, 3), {}, {}};
    sample.kappa = curvatureOf(sample.d, domain_);
    sample.slope = slopeOf(sample.d, domain_);
    return sample;
  }
  void push(const Sample& sample) {
    if (sample.kappa) points.push_back({sample.u, *sample.kappa});
  }
  /// Adds what lies after `a` up to `b`: more samples where the curve turns or slows down quickly, and the extremum
  /// between.
  void connect(const Sample& a, const Sample& b, int depth) {
    constexpr double kTurn = 0.15;     // sine of the turn between two samples: 9 degrees
    constexpr double kSlowing = 1.5;   // of the speeds at both ends
    constexpr int kMostHalvings = 12;  // of a step: ends them at a cusp, which has no shortest step
    const double va = a.d[1].norm(), vb = b.d[1].norm();
    const bool turns = std::abs(cross(a.d[1], b.d[1])) > kTurn * va * vb || a.d[1].dot(b.d[1]) < 0.0;
    const bool slows = std::max(va, vb) > kSlowing * std::min(va, vb);
    if ((turns || slows) && depth < kMostHalvings) {
      const Sample mid = sampleAt(0.5 * (a.u + b.u));
      connect(a, mid, depth + 1);
      connect(mid, b, depth + 1);
      return;
    }
    if (a.slope && b.slope && *a.slope * *b.slope < 0.0) refine(a, b);
    push(b);
  }
  void refine(const Sample& a, const Sample& b) {
    double low = a.u, high = b.u, lowSlope = *a.slope, highSlope = *b.slope;
    Sample found = a;
    int side = 0;
    // Regula falsi with the Illinois rule: as safe as bisection, much faster.
    for (int iteration = 0; iteration < 40; ++iteration) {
      const double u = std::clamp((low * highSlope - high * lowSlope) / (highSlope - lowSlope), low, high);
      const Sample mid = sampleAt(u);
      if (!mid.slope) break;
      found = mid;
      const double reach = high - low;
      if (*mid.slope == 0.0 || reach <= 1e-13 * domain_) break;
      const bool sameAsHigh = (*mid.slope > 0.0) == (highSlope > 0.0);
      const double before = sameAsHigh ? high : low;
      (sameAsHigh ? high : low) = u;
      (sameAsHigh ? highSlope : lowSlope) = *mid.slope;
      if (side == (sameAsHigh ? 1 : -1)) (sameAsHigh ? lowSlope : highSlope) *= 0.5;
      side = sameAsHigh ? 1 : -1;
      if (std::abs(u - before) <= 1e-13 * domain_) break;
    }
    if (found.u > a.u && found.u < b.u) push(found);
  }

  SpanPolynomials spans_;
  double domain_;
};

/// Runs over the profile; a closed one from its entry `begin` all around back to it.
std::vector<Profile::Point> ordered(const Profile& profile, std::size_t begin, bool periodic) {
  std::vector<Profile::Point> points = profile.points;
  if (!periodic || points.empty()) return points;
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(begin), points.end());
  points.push_back(points.front());
  return points;
}

std::size_t indexOfMax(const std::vector<Profile::Point>& points, const std::function<double(double)>& value) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (value(points[i].kappa) > value(points[best].kappa)) best = i;
  }
  return best;
}

/// All around from the highest value: the walk then ends as it began and no extremum can hide at the seam.
std::vector<Profile::Point> fromHighest(const Profile& profile, bool periodic) {
  return ordered(profile, indexOfMax(profile.points, [](double kappa) { return kappa; }), periodic);
}

std::vector<Profile::Point> fromMostBent(const Profile& profile, bool periodic) {
  return ordered(profile, indexOfMax(profile.points, [](double kappa) { return std::abs(kappa); }), periodic);
}

std::vector<ExtremumIndex> extremaOf(const std::vector<Profile::Point>& points, double prominence, bool periodic) {
  std::vector<double> kappas;
  kappas.reserve(points.size());
  for (const Profile::Point& p : points) kappas.push_back(p.kappa);
  return extremumIndices(kappas, prominence, periodic ? SequenceStart::OnMaximum : SequenceStart::AtEnd);
}

}  // namespace

std::optional<double> curvature(const NurbsCurve& curve, double u) {
  return curvatureOf(curve.derivatives(u, 2), curve.end() - curve.start());
}

std::optional<double> curvatureSlope(const NurbsCurve& curve, double u) {
  return slopeOf(curve.derivatives(u, 3), curve.end() - curve.start());
}

CurvatureCounts curvatureCounts(const NurbsCurve& curve, double prominence, bool periodic, CancelCheck check) {
  const Profile profile(curve, check);
  CurvatureCounts counts;
  if (profile.points.empty()) return counts;
  counts.extrema = static_cast<int>(extremaOf(fromHighest(profile, periodic), prominence, periodic).size());
  const double reach = std::max(prominence, std::numeric_limits<double>::min());
  int last = 0;
  for (const Profile::Point& p : fromMostBent(profile, periodic)) {
    if (!(std::abs(p.kappa) > reach)) continue;
    const int sign = p.kappa > 0.0 ? 1 : -1;
    if (last != 0 && sign != last) ++counts.inflections;
    last = sign;
  }
  return counts;
}

std::vector<CurvatureExtremumPoint> curvatureExtrema(const NurbsCurve& curve, double prominence, bool periodic,
                                                     CancelCheck check) {
  const Profile profile(curve, check);
  std::vector<CurvatureExtremumPoint> extrema;
  if (profile.points.empty()) return extrema;
  const auto points = fromHighest(profile, periodic);
  for (const ExtremumIndex& extremum : extremaOf(points, prominence, periodic)) {
    const Profile::Point& p = points[extremum.index];
    extrema.push_back({p.u, 0.0, p.kappa, extremum.maximum});
  }
  std::sort(extrema.begin(), extrema.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
  if (!extrema.empty()) {
    const ArcLength length(curve);
    for (auto& extremum : extrema) extremum.s = length.at(extremum.u);
  }
  return extrema;
}

int countedExtrema(const NurbsCurve& curve, bool periodic, CancelCheck check) {
  const double size = extent(curve);
  return size > 0.0 ? curvatureCounts(curve, kExtremumProminence / size, periodic, check).extrema : 0;
}

std::vector<double> inflections(const NurbsCurve& curve, double threshold, bool periodic, CancelCheck check) {
  const Profile profile(curve, check);
  std::vector<double> result;
  if (profile.points.empty()) return result;
  const auto points = fromMostBent(profile, periodic);
  const double reach = std::max(threshold, std::numeric_limits<double>::min());
  const Profile::Point* last = nullptr;  // The last one beyond the threshold.
  for (const Profile::Point& p : points) {
    if (check.isCancelled()) return {};
    if (!(std::abs(p.kappa) > reach)) continue;
    if (last != nullptr && (last->kappa > 0.0) != (p.kappa > 0.0)) {
      double low = last->u, high = p.u;
      const double domain = curve.end() - curve.start();
      if (high < low) high += domain;  // Across the seam of a closed curve.
      const auto wrapped = [&](double u) { return u > curve.end() ? u - domain : u; };
      for (int i = 0; i < 60 && high - low > 1e-14 * domain; ++i) {
        const double mid = 0.5 * (low + high);
        const double kappa = curvature(curve, wrapped(mid)).value_or(0.0);
        ((kappa > 0.0) == (last->kappa > 0.0) && kappa != 0.0 ? low : high) = mid;
      }
      result.push_back(wrapped(0.5 * (low + high)));
    }
    last = &p;
  }
  std::sort(result.begin(), result.end());
  return result;
}

double extent(const NurbsCurve& curve) {
  Vec2 low = curve.controlPoints().front(), high = low;
  for (const Vec2& p : curve.controlPoints()) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

}  // namespace batten
