// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner_geometry.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double kUnrefinedWeight = 0.1;  // points known to the pixel only
constexpr double kOutlineZonePx = 4.0;
constexpr double kFarthestMeetPx = 6.0;    // of the meeting point from the contour
constexpr double kFarthestTipPx = 16.0;    // acute tips are eaten away by blur and threshold
constexpr double kSmallestSine = 0.08;     // of the angle between the sides; below, the meeting point is ill-conditioned
constexpr int kNewtonSteps = 12;

struct Meeting {
  Vec2 position = Vec2::Zero();
  double angle = 0.0;  // in the image frame
  bool ok = false;
};

// Newton for fit a(s) = b(t), from s = t = 0.
Meeting meet(const LocalQuadratic& a, const LocalQuadratic& b, double scale) {
  Meeting m;
  double s = 0.0, t = 0.0;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Vec2 da = a.derivative(s), db = b.derivative(t);
    const double det = -cross(da, db);
    if (std::abs(det) < kSmallestSine * da.norm() * db.norm() || !(det != 0.0)) return m;
    const Vec2 gap = b.at(t) - a.at(s);
    // Solve da * ds - db * dt = gap.
    const double ds = -cross(gap, db) / det;
    const double dt = -cross(gap, da) / det;
    s += std::clamp(ds, -scale, scale);
    t += std::clamp(dt, -scale, scale);
    if (std::abs(s) > 2.0 * scale || std::abs(t) > 2.0 * scale) return m;
    if (std::abs(ds) + std::abs(dt) < 1e-9 * scale) break;
  }
  if ((a.at(s) - b.at(t)).norm() > 1e-3) return m;
  m.position = 0.5 * (a.at(s) + b.at(t));
  const Vec2 in = -a.derivative(s), out = b.derivative(t);
  m.angle = std::atan2(cross(in, out), in.dot(out));
  m.ok = m.position.allFinite();
  return m;
}

// The longest stretch that one parabola still describes as well as the short one: more points, less noise.
OneSidedFit longestGoodFit(const Contour& contour, int index, int side, double inner, double outer) {
  const double span = outer - inner;
  OneSidedFit best = fitOneSide(contour, index, side, inner, inner + std::min(span, 20.0));
  for (const double length : {32.0, 48.0}) {
    if (span < length) break;
    const OneSidedFit longer = fitOneSide(contour, index, side, inner, inner + length);
    if (longer.fit.order < 2 || longer.fit.residualRms > 1.08 * best.fit.residualRms) break;
    best = longer;
  }
  return best;
}

double turn(const Vec2& in, const Vec2& out) { return -std::atan2(cross(in, out), in.dot(out)); }

}  // namespace

OneSidedFit fitOneSide(const Contour& contour, int index, int side, double inner, double outer, int maxOrder) {
  OneSidedFit result;
  const int n = static_cast<int>(contour.points.size());
  std::vector<double> s, weights;
  std::vector<Vec2> points;
  double arc = 0.0;
  const int most = contour.closed ? n / 2 : n;
  for (int k = 0; k < most; ++k) {
    const int i = contour.closed ? wrapIndex(index + side * k, n) : index + side * k;
    if (i < 0 || i >= n) break;
    const auto at = static_cast<std::size_t>(i);
    if (k > 0) {
      const int j = contour.closed ? wrapIndex(i - side, n) : i - side;
      arc += (contour.points[at] - contour.points[static_cast<std::size_t>(j)]).norm();
    }
    if (arc > outer) break;
    if (arc < inner) continue;
    s.push_back(arc);
    points.push_back(contour.points[at]);
    weights.push_back(at < contour.refined.size() && contour.refined[at] == 0 ? kUnrefinedWeight : 1.0);
  }
  if (s.size() < 3) return result;
  result.fit = fitLocalQuadratic(s, points, weights, maxOrder);
  if (result.fit.order >= 1) result.reach = s.back() - s.front();
  return result;
}

std::optional<Turning> turningAt(const Contour& contour, int index, double inner, double outer) {
  const OneSidedFit before = fitOneSide(contour, index, -1, inner, outer);
  const OneSidedFit after = fitOneSide(contour, index, 1, inner, outer);
  if (before.reach <= 0.4 * (outer - inner) || after.reach <= 0.4 * (outer - inner)) return std::nullopt;
  Turning t;
  t.angleRad = turn(-before.fit.r1, after.fit.r1);
  // Where the index is off the corner one parabola swallows it: it fits badly there and the two do not meet.
  const double misfit = std::max(before.fit.residualRms, after.fit.residualRms) / (0.02 * outer + 0.1);
  const double gap = (before.fit.r0 - after.fit.r0).norm() / (0.15 * outer + 0.5);
  t.score = std::abs(t.angleRad) / (1.0 + misfit * misfit + gap * gap);
  return t;
}

double roundedZonePx(const Contour& contour, int index) {
  if (contour.kind == ContourKind::Outline) return kOutlineZonePx;
  const auto i = static_cast<std::size_t>(index);
  return i < contour.widthPx.size() ? std::clamp(static_cast<double>(contour.widthPx[i]), 3.0, 60.0) : kOutlineZonePx;
}

CornerFix locateCorner(const Contour& contour, int index, double inner, double outerBefore, double outerAfter) {
  CornerFix result;
  result.position = contour.points[static_cast<std::size_t>(index)];
  // Twice: the first meeting point says which contour point is really nearest and so where the rounded zone lies.
  int at = index;
  const int n = static_cast<int>(contour.points.size());
  for (int round = 0; round < 2; ++round) {
    const OneSidedFit before = longestGoodFit(contour, at, -1, inner, outerBefore);
    const OneSidedFit after = longestGoodFit(contour, at, 1, inner, outerAfter);
    if (before.reach <= 0.0 || after.reach <= 0.0) return result;
    result.angleRad = turn(-before.fit.r1, after.fit.r1);
    Meeting m = meet(before.fit, after.fit, inner + 20.0);
    if (!m.ok) {
      const OneSidedFit lineBefore = fitOneSide(contour, at, -1, inner, inner + std::min(10.0, outerBefore), 1);
      const OneSidedFit lineAfter = fitOneSide(contour, at, 1, inner, inner + std::min(10.0, outerAfter), 1);
      if (lineBefore.reach > 0.0 && lineAfter.reach > 0.0) m = meet(lineBefore.fit, lineAfter.fit, inner + 20.0);
    }
    if (!m.ok) return result;
    const double halfTip = 0.5 * (3.14159265358979 - std::abs(m.angle));
    const double farthest = std::clamp(1.5 / std::max(0.05, std::sin(std::abs(halfTip))), kFarthestMeetPx, kFarthestTipPx);
    double nearest = 1e300;
    const int reach = static_cast<int>(farthest * 2.0) + 4;
    int nearestIndex = at;
    for (int k = -reach; k <= reach; ++k) {
      const int i = contour.closed ? wrapIndex(at + k, n) : at + k;
      if (i < 0 || i >= n) continue;
      const double d = (contour.points[static_cast<std::size_t>(i)] - m.position).squaredNorm();
      if (d < nearest) nearest = d, nearestIndex = i;
    }
    if (std::sqrt(nearest) > farthest) return result;
    result.position = m.position;
    result.angleRad = -m.angle;
    result.exact = true;
    if (nearestIndex == at) break;
    at = nearestIndex;
  }
  return result;
}

}  // namespace batten
