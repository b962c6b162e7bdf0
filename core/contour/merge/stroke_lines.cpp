// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLook = 1.5;  // distances over which an end is looked at
constexpr double kLeastLookPx = 12.0;
constexpr double kSeamSmoothing = 3.0;  // points
constexpr int kSeamReach = 12;          // points on either side

void dropLast(MeanLine& line) {
  line.points.pop_back();
  line.tangent.pop_back();
  line.source.pop_back();
  line.weight.pop_back();
}

// The two parts of a line meet before `joint` to within a few pixels: a little smoothing there.
void smoothSeam(std::vector<Vec2>& points, int joint) {
  const auto from = points.begin() + std::max(0, joint - kSeamReach),
             to = points.begin() + std::min(static_cast<int>(points.size()), joint + kSeamReach);
  std::ranges::copy(smoothPolyline(std::vector<Vec2>(from, to), false, kSeamSmoothing), from);
}

// Cuts off what lies beyond the start of what follows.
void giveIn(MeanLine& line, const Vec2& start, const Vec2& direction, double mostPx) {
  double given = 0.0;
  while (line.points.size() > 3 && given < mostPx && (start - line.points.back()).dot(direction) < 1.0) {
    given += (line.points.back() - line.points[line.points.size() - 2]).norm();
    dropLast(line);
  }
}

// The line ends at a place near its end: what goes beyond is cut off.
void endLineAt(MeanLine& line, int side, const Vec2& place) {
  if (side == 0) reverseLine(line);
  const std::size_t n = line.tangent.size();
  const Vec2 out = line.tangent[n > 8 ? n - 5 : n - 1];
  while (line.points.size() > 3 && (place - line.points.back()).dot(out) < 0.5) dropLast(line);
  line.points.push_back(place);
  line.tangent.push_back(line.tangent.back());
  line.source.push_back(line.source.back());
  line.weight.push_back(line.weight.back());
  if (side == 0) reverseLine(line);
}

}  // namespace

double turnDeg(const Vec2& a, const Vec2& b) {
  return std::atan2(std::abs(cross(a, b)), a.dot(b)) * 180.0 / std::numbers::pi;
}

void reverseLine(MeanLine& line) {
  std::reverse(line.points.begin(), line.points.end());
  std::reverse(line.tangent.begin(), line.tangent.end());
  for (Vec2& t : line.tangent) t = -t;
  std::reverse(line.source.begin(), line.source.end());
  std::reverse(line.weight.begin(), line.weight.end());
}

MeanLine partOf(const MeanLine& line, int from, int to) {
  const auto cut = [&](const auto& v) { return std::decay_t<decltype(v)>(v.begin() + from, v.begin() + to + 1); };
  MeanLine p;
  p.points = cut(line.points);
  p.tangent = cut(line.tangent);
  p.source = cut(line.source);
  p.weight = cut(line.weight);
  return p;
}

void turnTo(MeanLine& line, int first) {
  const auto turn = [first](auto& v) { std::rotate(v.begin(), v.begin() + first, v.end()); };
  turn(line.points);
  turn(line.tangent);
  turn(line.source);
  turn(line.weight);
}

void appendLine(MeanLine& line, const MeanLine& more, double mostPx) {
  giveIn(line, more.points.front(), more.tangent.front(), mostPx);
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  const int joint = static_cast<int>(line.points.size());
  add(line.points, more.points);
  add(line.tangent, more.tangent);
  add(line.source, more.source);
  add(line.weight, more.weight);
  smoothSeam(line.points, joint);
}

void closeLine(MeanLine& line, double mostPx) {
  giveIn(line, line.points.front(), line.tangent.front(), mostPx);
  line.closed = true;
  // Half a turn brings the seam where there are points on both sides.
  const auto n = static_cast<int>(line.points.size());
  turnTo(line, n / 2);
  smoothSeam(line.points, n - n / 2);
}

EndTangent endTangent(const MeanLine& line, int side, double distancePx) {
  const int n = static_cast<int>(line.points.size());
  const int skip = static_cast<int>(std::min(0.5 * distancePx, 0.25 * n));
  const double reach = std::max(kLeastLookPx, std::min(kLook * distancePx, 0.5 * n));
  std::vector<double> s;
  std::vector<Vec2> p;
  for (int k = skip; k < n && k - skip <= reach; ++k) {
    s.push_back(k);
    p.push_back(line.points[side == 0 ? k : n - 1 - k]);
  }
  const LocalQuadratic fit = fitLocalQuadratic(s, p, {}, static_cast<double>(p.size()) >= 0.5 * reach ? 2 : 1);
  EndTangent e;
  if (fit.order < 1 || !(fit.r1.norm() > 0.0)) {
    e.at = side == 0 ? line.points.front() : line.points.back();
    e.into = side == 0 ? line.tangent.front() : Vec2(-line.tangent.back());
    return e;
  }
  return {fit.r0, fit.r1.normalized()};
}

void meetAtTurns(std::vector<MeanLine>& lines, const std::vector<Vec2>& turns, double distancePx) {
  for (const Vec2& turn : turns) {
    std::vector<std::pair<double, int>> near;
    for (int e = 0; e < 2 * static_cast<int>(lines.size()); ++e) {
      const MeanLine& l = lines[e / 2];
      if (l.closed || l.points.size() < 3) continue;
      const double d = ((e % 2 == 0 ? l.points.front() : l.points.back()) - turn).norm();
      if (d <= distancePx) near.emplace_back(d, e);
    }
    if (near.size() < 2) continue;
    std::sort(near.begin(), near.end());
    const int a = near[0].second, b = near[1].second;
    const EndTangent p = endTangent(lines[a / 2], a % 2, distancePx), q = endTangent(lines[b / 2], b % 2, distancePx);
    // Where the lines would meet; at a small angle, or if they would have to go far for it, halfway.
    const double sine = cross(p.into, q.into);
    Vec2 corner = 0.5 * (p.at + q.at);
    if (std::abs(sine) > 0.3) {
      const Vec2 meet = p.at + cross(Vec2(q.at - p.at), q.into) / sine * p.into;
      if ((meet - p.at).norm() <= distancePx && (meet - q.at).norm() <= distancePx) corner = meet;
    }
    for (const int e : {a, b}) endLineAt(lines[e / 2], e % 2, corner);
  }
}

}  // namespace batten
