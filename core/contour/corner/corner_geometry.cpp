// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/contour/corner/corner_pixels.h"
#include "core/contour/corner/corner_sides.h"
#include "core/contour/corner/side_points.h"

namespace batten {
namespace {

constexpr double kUnrefinedWeight = 0.1;       // points known to the pixel only
constexpr double kOutlineZonePx = 4.0;         // what blur and mask round of the corner of an outline
constexpr double kFarthestMeetPx = 6.0;        // of the meeting point from the contour
constexpr double kFarthestStrokeMeetPx = 9.0;  // of thin strokes; beyond, sides that nearly touch meet off the ink
constexpr double kEatenHalfPx = 4.0;    // half the width at which the tip of a shape is eaten away by blur and the mask
constexpr double kFilledHalfPx = 3.0;   // half of a gap between two sides of a stroke that blur and the mask may fill
constexpr double kSmallestSine = 0.08;  // of the angle between the sides; below, the meeting point is ill-conditioned
constexpr int kCornerNewtonSteps = 12;  // fewer once the meeting point is settled
constexpr int kLocateRounds = 4;        // of zone and meeting point in turn; fewer once they are settled
constexpr double kFreeSidesPx = 6.0;    // sides nearer to each other than this share their blur
constexpr double kFarthestPixelMovePx = 3.0;  // from where the sides meet: farther off lies another edge
constexpr double kFarthestScales = 2.0;       // of what is looked at: a side extended farther says nothing
constexpr double kSettled = 1e-9;             // of that
constexpr double kMeetPx = 1e-3;              // between the two sides where they meet
constexpr double kExtensions = 2.0;           // of the farthest tip: a side is extended as far
constexpr double kLeastReach = 0.4;           // of the requested stretch: a shorter side is none
// What a side may miss its points by, and the two each other: the part that grows with the stretch is that of arcs.
constexpr double kMisfitShare = 0.02, kMisfitPx = 0.1, kGapShare = 0.15, kSideGapPx = 0.5;
constexpr double kLeastZonePx = 3.0, kMostZonePx = 60.0;                 // of a stroke's corner, otherwise its width
constexpr double kSharpestHalfTipRad = 0.03, kFlattestHalfTipRad = 1.5;  // 2 and 86 degrees: keep sine and tangent sane
constexpr double kSettledZonePx = 0.5;                                   // points lie no nearer to each other
// Points lie half a pixel apart or more, and a few are looked at beyond.
constexpr double kNearestPerPx = 2.0;
constexpr int kNearestBeyond = 4;
constexpr double kFitOuterPx = 260.0;   // looked at on either side at most
constexpr double kWidestZonePx = 14.0;  // beyond the rounded one

struct Meeting {
  Vec2 position = Vec2::Zero();
  double angle = 0.0;  // in the image frame
};

// Newton for a(s) = b(t), from s = t = 0; nothing where the sides do not meet well.
std::optional<Meeting> meet(const CornerSide& a, const CornerSide& b, double scale) {
  double s = 0.0, t = 0.0;
  for (int step = 0; step < kCornerNewtonSteps; ++step) {
    const Vec2 da = a.derivative(s), db = b.derivative(t);
    const double det = -cross(da, db);
    if (std::abs(det) < kSmallestSine * da.norm() * db.norm() || !(det != 0.0)) return std::nullopt;
    const Vec2 gap = b.at(t) - a.at(s);
    // Solve da * ds - db * dt = gap.
    const double ds = -cross(gap, db) / det;
    const double dt = -cross(gap, da) / det;
    s += std::clamp(ds, -scale, scale);
    t += std::clamp(dt, -scale, scale);
    if (std::abs(s) > kFarthestScales * scale || std::abs(t) > kFarthestScales * scale) return std::nullopt;
    if (std::abs(ds) + std::abs(dt) < kSettled * scale) break;
  }
  if ((a.at(s) - b.at(t)).norm() > kMeetPx) return std::nullopt;
  Meeting m;
  m.position = 0.5 * (a.at(s) + b.at(t));
  const Vec2 in = -a.derivative(s), out = b.derivative(t);
  m.angle = std::atan2(cross(in, out), in.dot(out));
  if (!m.position.allFinite()) return std::nullopt;
  return m;
}

double turningAngle(const Vec2& in, const Vec2& out) { return -std::atan2(cross(in, out), in.dot(out)); }

// [px of arc] What of a line is looked at on either side of a corner.
struct SideReach {
  double inner = 0.0, before = 0.0, after = 0.0;
};

std::optional<CornerSides> fitSides(const Contour& contour, int at, const SideReach& reach) {
  auto before = fitCornerSide(contour, at, -1, reach.inner, reach.before);
  auto after = fitCornerSide(contour, at, 1, reach.inner, reach.after);
  if (!before || !after) return std::nullopt;
  return CornerSides{*before, *after};
}

// Moves a corner to where its pixels place it, unless that lies too far away.
CornerFix fitToPixels(const GreyImage& grey, double blurPx, const CornerSides& sides, CornerFix fix) {
  const auto fitted = fitCornerToPixels(grey, fix.position, blurPx, sides);
  if (!fitted) return fix;
  const auto m = meet(fitted->before, fitted->after, fix.zonePx + kExtensions * kFarthestTipPx);
  if (!m || (m->position - fix.position).norm() > kFarthestPixelMovePx) return fix;
  fix.position = m->position;
  fix.angleRad = -m->angle;
  return fix;
}

}  // namespace

NearestPoint nearestAlong(const Contour& contour, int at, const Vec2& position, int reach) {
  const int n = static_cast<int>(contour.points.size());
  NearestPoint best{at, (contour.points[at].at - position).norm()};
  for (int k = -reach; k <= reach; ++k) {
    const int i = contour.closed ? wrapIndex(at + k, n) : at + k;
    if (i < 0 || i >= n) continue;
    const double d = (contour.points[i].at - position).norm();
    if (d < best.distance) best = {i, d};
  }
  return best;
}

std::optional<OneSidedFit> fitOneSide(const Contour& contour, int index, int side, double inner, double outer,
                                      int maxOrder) {
  std::vector<double> s, weights;
  std::vector<Vec2> points;
  forPointsAside(contour, index, side, {inner, outer}, [&](const ContourPoint& p, double arc) {
    s.push_back(arc);
    points.push_back(p.at);
    weights.push_back(p.refined ? 1.0 : kUnrefinedWeight);
  });
  if (s.size() < 3) return std::nullopt;
  const LocalQuadratic fit = fitLocalQuadratic(s, points, weights, maxOrder);
  const double reach = s.back() - s.front();
  if (fit.order < 1 || !(reach > 0.0)) return std::nullopt;
  return OneSidedFit{fit, reach};
}

std::optional<Turning> turningAt(const Contour& contour, int index, double inner, double outer, int maxOrder) {
  const auto before = fitOneSide(contour, index, -1, inner, outer, maxOrder);
  const auto after = fitOneSide(contour, index, 1, inner, outer, maxOrder);
  const double least = kLeastReach * (outer - inner);
  if (!before || !after || before->reach <= least || after->reach <= least) return std::nullopt;
  Turning t;
  t.angleRad = turningAngle(-before->fit.r1, after->fit.r1);
  // Where the index is off the corner one parabola swallows it: it fits badly there and the two do not meet.
  const double misfit = std::max(before->fit.residualRms, after->fit.residualRms) / (kMisfitShare * outer + kMisfitPx);
  const double gap = (before->fit.r0 - after->fit.r0).norm() / (kGapShare * outer + kSideGapPx);
  t.score = std::abs(t.angleRad) / (1.0 + misfit * misfit + gap * gap);
  return t;
}

double roundedZonePx(const Contour& contour, int index) {
  if (contour.kind == ContourKind::Outline) return kOutlineZonePx;
  const std::optional<float> widthPx = contour.points[index].widthPx;
  return widthPx ? std::clamp(static_cast<double>(*widthPx), kLeastZonePx, kMostZonePx) : kOutlineZonePx;
}

CornerFix locateCorner(const Contour& contour, int index, double inner, double outerBefore, double outerAfter,
                       const GreyImage* grey) {
  CornerFix result;
  result.position = contour.points[index].at;
  result.zonePx = inner;
  // Several times: the meeting point says which contour point is really nearest and so where the rounded zone lies, and
  // the angle says how far the sides are near enough to blur into each other.
  int at = index;
  double zone = inner;
  // Two sides of a stroke have one middle until they are a stroke's width apart.
  const double eatenHalf = contour.kind == ContourKind::Outline ? kEatenHalfPx : 0.5 * inner + kFilledHalfPx;
  const double blending = contour.kind == ContourKind::Outline ? kFreeSidesPx : inner + kFreeSidesPx;
  // The middle of a stroke is led to the tip of a corner; that of a bundle of strokes is not.
  const bool reachesTip = contour.kind == ContourKind::Centreline && !contour.points[index].bundle;
  std::optional<CornerSides> sides;
  for (int round = 0; round < kLocateRounds; ++round) {
    const double shorter = std::min(outerBefore, outerAfter);
    const double from = std::clamp(zone, inner, std::max(inner, 0.5 * shorter));
    sides = fitSides(contour, at, {from, outerBefore, outerAfter});
    if (!sides) return result;
    result.angleRad = turningAngle(-sides->before.derivative(0.0), sides->after.derivative(0.0));
    const auto m = meet(sides->before, sides->after, from + kExtensions * kFarthestTipPx);
    if (!m) return result;
    const double halfTip = std::max(kSharpestHalfTipRad, 0.5 * (std::numbers::pi - std::abs(m->angle)));
    const double most = reachesTip ? std::max(kFarthestStrokeMeetPx, inner) : kFarthestTipPx;
    const double farthest = std::clamp(eatenHalf / std::sin(halfTip), kFarthestMeetPx, most);
    const NearestPoint nearest =
        nearestAlong(contour, at, m->position, static_cast<int>(farthest * kNearestPerPx) + kNearestBeyond);
    if (nearest.distance > farthest) return result;
    result.position = m->position;
    result.angleRad = -m->angle;
    result.exact = true;
    result.zonePx = from;
    // From the tip, where the contour may have ended before it.
    const double free = blending / (2.0 * std::tan(std::min(halfTip, kFlattestHalfTipRad))) - nearest.distance;
    const double nextZone = std::clamp(free, inner, inner + kWidestZonePx);
    if (nearest.index == at && std::abs(nextZone - zone) < kSettledZonePx) break;
    at = nearest.index;
    zone = nextZone;
  }
  if (grey != nullptr && contour.blurPx) return fitToPixels(*grey, *contour.blurPx, *sides, result);
  return result;
}

std::vector<CornerFix> locateCorners(const Contour& contour, std::span<const int> indices, const RunContext& context,
                                     const GreyImage* grey) {
  std::vector<CornerFix> fixes;
  const int count = static_cast<int>(indices.size());
  if (count == 0) return fixes;
  const std::vector<Vec2> points = positionsOf(contour.points);
  const std::vector<double> arc = cumulativeLength(points);
  const double length = polylineLength(points, contour.closed);
  const auto s = [&](int i) { return arc[indices[i]]; };
  for (int i = 0; i < count && !context.isCancelled(); ++i) {
    double before = s(i), after = length - s(i);
    if (contour.closed) {
      before = i > 0 ? s(i) - s(i - 1) : s(i) + length - s(count - 1);
      after = i + 1 < count ? s(i + 1) - s(i) : s(0) + length - s(i);
      if (count == 1) before = after = 0.5 * length;
    } else {
      if (i > 0) before = s(i) - s(i - 1);
      if (i + 1 < count) after = s(i + 1) - s(i);
    }
    const double zone = roundedZonePx(contour, indices[i]);
    const auto outer = [&](double free, bool toCorner) {
      return std::clamp(free - (toCorner ? zone : 0.0), 0.0, kFitOuterPx + 2.0 * (zone - kOutlineZonePx));
    };
    const bool cornerBefore = contour.closed ? count > 1 : i > 0;
    const bool cornerAfter = contour.closed ? count > 1 : i + 1 < count;
    fixes.push_back(
        locateCorner(contour, indices[i], zone, outer(before, cornerBefore), outer(after, cornerAfter), grey));
  }
  return fixes;
}

}  // namespace batten
