// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLook = 1.5;                    // distances over which an end is looked at
constexpr double kLeastLookPx = 12.0;            // over less, the steps of pixels give the direction
constexpr double kSeamSmoothing = 3.0;           // points
constexpr int kSeamReach = 12;                   // points on either side
constexpr double kCurvedEnd = 0.5;               // of that: over less, a parabola follows the noise
constexpr double kBentEnd = 0.5;                 // distances: means are bent so far from their ends,
constexpr double kBentEndShare = 0.25;           // or for this part of a short one
constexpr int kLongEnough = 8, kBeforeBend = 5;  // points: of a line with so many the direction is read before its end
constexpr double kSeamAdvancePx = 1.0, kEndAdvancePx = 0.5;  // less ahead of a line it would fold: it is cut back
constexpr double kMeetingSine = 0.3;  // 17 degrees: at a smaller angle the place of meeting is uncertain

// The two parts of a line meet before `joint` to within a few pixels: a little smoothing there.
void smoothSeam(MeanLine& line, int joint) {
  const int from = std::max(0, joint - kSeamReach), to = std::min(line.count(), joint + kSeamReach);
  std::vector<Vec2> seam;
  for (int i = from; i < to; ++i) seam.push_back(line.points[i].at);
  seam = smoothPolyline(seam, false, kSeamSmoothing);
  for (int i = from; i < to; ++i) line.points[i].at = seam[i - from];
}

// Cuts off what lies beyond the start of what follows.
void giveIn(MeanLine& line, const Vec2& start, const Vec2& direction, double mostPx) {
  double given = 0.0;
  while (line.points.size() > 3 && given < mostPx && (start - line.points.back().at).dot(direction) < kSeamAdvancePx) {
    given += (line.points.back().at - line.points[line.count() - 2].at).norm();
    line.points.pop_back();
  }
}

// The line ends at a place near its end: what goes beyond is cut off.
void endLineAt(MeanLine& line, int side, const Vec2& place) {
  if (side == 0) reverseLine(line);
  const int n = line.count();
  const Vec2 out = line.points[n > kLongEnough ? n - kBeforeBend : n - 1].tangent;
  while (line.points.size() > 3 && (place - line.points.back().at).dot(out) < kEndAdvancePx) line.points.pop_back();
  MeanPoint last = line.points.back();
  last.at = place;
  line.points.push_back(last);
  if (side == 0) reverseLine(line);
}

}  // namespace

void reverseLine(MeanLine& line) {
  std::reverse(line.points.begin(), line.points.end());
  for (MeanPoint& p : line.points) p.tangent = -p.tangent;
}

MeanLine partOf(const MeanLine& line, int from, int to) {
  MeanLine part;
  part.points.assign(line.points.begin() + from, line.points.begin() + to + 1);
  return part;
}

void startAt(MeanLine& ring, int first) {
  std::rotate(ring.points.begin(), ring.points.begin() + first, ring.points.end());
}

void appendLine(MeanLine& line, const MeanLine& more, double mostPx) {
  giveIn(line, more.points.front().at, more.points.front().tangent, mostPx);
  const int joint = line.count();
  line.points.insert(line.points.end(), more.points.begin(), more.points.end());
  smoothSeam(line, joint);
}

void closeLine(MeanLine& line, double mostPx) {
  giveIn(line, line.points.front().at, line.points.front().tangent, mostPx);
  line.closed = true;
  // Half way round, so that the seam lies where there are points on both sides.
  const int n = line.count();
  startAt(line, n / 2);
  smoothSeam(line, n - n / 2);
}

EndTangent endTangent(const MeanLine& line, int side, double distancePx) {
  const int n = line.count();
  const int skip = static_cast<int>(std::min(kBentEnd * distancePx, kBentEndShare * n));
  const double reach = std::max(kLeastLookPx, std::min(kLook * distancePx, 0.5 * n));
  const auto point = [&](int k) -> const MeanPoint& { return line.points[side == 0 ? k : n - 1 - k]; };
  std::vector<double> s;
  std::vector<Vec2> at;
  for (int k = skip; k < n && k - skip <= reach; ++k) {
    s.push_back(k);
    at.push_back(point(k).at);
  }
  const LocalQuadratic fit = fitLocalQuadratic(s, at, {}, static_cast<double>(at.size()) >= kCurvedEnd * reach ? 2 : 1);
  if (fit.order >= 1 && fit.r1.norm() > 0.0) return {fit.r0, fit.r1.normalized()};
  const MeanPoint& end = point(0);
  return {end.at, side == 0 ? end.tangent : Vec2(-end.tangent)};
}

void meetAtTurns(std::vector<MeanLine>& lines, const std::vector<Vec2>& turns, double distancePx) {
  for (const Vec2& turn : turns) {
    std::vector<std::pair<double, int>> near;
    for (int e = 0; e < 2 * static_cast<int>(lines.size()); ++e) {
      const MeanLine& l = lines[e / 2];
      if (l.closed || l.points.size() < 3) continue;
      const double d = ((e % 2 == 0 ? l.points.front() : l.points.back()).at - turn).norm();
      if (d <= distancePx) near.emplace_back(d, e);
    }
    if (near.size() < 2) continue;
    std::sort(near.begin(), near.end());
    const int a = near[0].second, b = near[1].second;
    const EndTangent p = endTangent(lines[a / 2], a % 2, distancePx), q = endTangent(lines[b / 2], b % 2, distancePx);
    // Where the lines would meet; at a small angle, or if they would have to go far for it, halfway.
    const double sine = cross(p.into, q.into);
    Vec2 corner = 0.5 * (p.at + q.at);
    if (std::abs(sine) > kMeetingSine) {
      const Vec2 meet = p.at + cross(Vec2(q.at - p.at), q.into) / sine * p.into;
      if ((meet - p.at).norm() <= distancePx && (meet - q.at).norm() <= distancePx) corner = meet;
    }
    for (const int e : {a, b}) endLineAt(lines[e / 2], e % 2, corner);
  }
}

}  // namespace batten
