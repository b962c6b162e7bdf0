// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/drawn_profile.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace batten {
namespace {

/// Slope between two intervals: their weighted harmonic mean, 0 where they disagree (Fritsch and Butland, eq. 5).
double innerSlope(double h0, double d0, double h1, double d1) {
  if (!(d0 * d1 > 0.0)) return 0.0;
  const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// One-sided three-point slope, bounded so that the first interval stays monotone.
double endSlope(double h0, double d0, double h1, double d1) {
  const double slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!(slope * d0 > 0.0)) return 0.0;
  return d0 * d1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(d0) ? 3.0 * d0 : slope;
}

std::vector<ProfilePoint> overWholePerimeter(std::span<const ProfilePoint> given, bool closed) {
  std::vector<ProfilePoint> points(given.begin(), given.end());
  if (closed) {
    ProfilePoint &first = points.front(), &last = points.back();
    if (first.fraction <= 0.0 && last.fraction >= 1.0) {
      first.kappa = last.kappa = 0.5 * (first.kappa + last.kappa);
    } else if (first.fraction <= 0.0) {
      points.push_back({1.0, first.kappa});
    } else if (last.fraction >= 1.0) {
      points.insert(points.begin(), {0.0, last.kappa});
    } else {
      const double gap = first.fraction + 1.0 - last.fraction, t = (1.0 - last.fraction) / gap;
      const double seam = (1.0 - t) * last.kappa + t * first.kappa;
      points.push_back({1.0, seam});
      points.insert(points.begin(), {0.0, seam});
    }
  } else {
    if (points.front().fraction > 0.0) points.insert(points.begin(), {0.0, points.front().kappa});
    if (points.back().fraction < 1.0) points.push_back({1.0, points.back().kappa});
  }
  return points;
}

}  // namespace

std::optional<Error> validateProfile(std::span<const ProfilePoint> points) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (points.empty()) return std::nullopt;
  if (points.size() < 2) return bad("A drawn profile needs at least two points.");
  if (points.size() > kMostProfilePoints) return bad("A drawn profile can have at most 200 points.");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].kappa)) return bad("A drawn profile holds a curvature that is not a number.");
    if (!(points[i].fraction >= 0.0 && points[i].fraction <= 1.0)) {
      return bad("The places of a drawn profile must lie between 0 and 1.");
    }
    if (i > 0 && !(points[i].fraction > points[i - 1].fraction)) {
      return bad("The places of a drawn profile must ascend.");
    }
  }
  return std::nullopt;
}

TargetProfile drawnProfile(std::span<const ProfilePoint> given, bool closed) {
  TargetProfile profile;
  profile.degree = 3;
  profile.quantity = TargetQuantity::Curvature;
  if (given.empty() || validateProfile(given)) {
    profile.problem = given.empty() ? "No profile is drawn yet: drag its points in the plot, or set fairing.profile."
                                    : validateProfile(given)->message;
    return profile;
  }
  const std::vector<ProfilePoint> points = overWholePerimeter(given, closed);
  const std::size_t intervals = points.size() - 1;
  std::vector<double> h(intervals), d(intervals);
  for (std::size_t i = 0; i < intervals; ++i) {
    h[i] = points[i + 1].fraction - points[i].fraction;
    d[i] = (points[i + 1].kappa - points[i].kappa) / h[i];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    double slope = d[std::min(i, intervals - 1)];
    if (i > 0 && i < intervals) {
      slope = innerSlope(h[i - 1], d[i - 1], h[i], d[i]);
    } else if (closed) {
      slope = innerSlope(h.back(), d.back(), h.front(), d.front());
    } else if (intervals > 1) {
      const std::size_t near = i == 0 ? 0 : intervals - 1, far = i == 0 ? 1 : intervals - 2;
      slope = endSlope(h[near], d[near], h[far], d[far]);
    }
    profile.nodes.push_back({points[i].fraction, points[i].kappa, slope});
  }
  profile.valid = true;
  int rises = 0, falls = 0;
  for (const double slope : d) (slope > 0.0 ? rises : falls) += slope != 0.0;
  profile.isMonotone = rises == 0 || falls == 0;
  return profile;
}

}  // namespace batten
