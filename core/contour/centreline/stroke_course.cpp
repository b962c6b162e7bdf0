// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/stroke_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/centreline/stroke_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kTangentReach = 2;

std::vector<Vec2> positions(const std::vector<StrokePathPoint>& points) {
  std::vector<Vec2> at;
  at.reserve(points.size());
  for (const StrokePathPoint& p : points) at.push_back(p.at);
  return at;
}

// The stroke path at even steps of about 1 px. Parts go to the nearest old point.
void resample(const std::vector<Vec2>& at, const std::vector<StrokePathPoint>& points, StrokeCourse& course) {
  const auto n = at.size();
  std::vector<double> s = cumulativeLength(at);
  const double total = s.back() + (course.closed ? (at.front() - at.back()).norm() : 0.0);
  const int steps = std::max(course.closed ? 4 : 1, static_cast<int>(std::lround(total)));
  const int count = course.closed ? steps : steps + 1;
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    const double want = total * i / steps;
    while (k + 1 < n && s[k + 1] < want) ++k;
    const std::size_t next = k + 1 < n ? k + 1 : (course.closed ? 0 : k);
    const double span = (k + 1 < n ? s[k + 1] : total) - s[k];
    const double t = span > 0.0 ? std::clamp((want - s[k]) / span, 0.0, 1.0) : 0.0;
    course.chain.push_back((1.0 - t) * at[k] + t * at[next]);
    course.radius.push_back(static_cast<float>((1.0 - t) * points[k].radius + t * points[next].radius));
    course.part.push_back(points[t < 0.5 ? k : next].part);
  }
}

float medianOf(std::vector<float> values) {
  if (values.empty()) return 0.0f;
  return upperMedian(values);
}

// Values without a measurement are laid straight between those that have one.
void fillBetween(std::vector<float>& values, const std::vector<std::uint8_t>& known, bool closed, float otherwise) {
  const int n = static_cast<int>(values.size());
  const auto first = static_cast<int>(std::find(known.begin(), known.end(), 1) - known.begin());
  if (first == n) {
    std::fill(values.begin(), values.end(), otherwise);
    return;
  }
  const auto at = [&](int i) -> float& { return values[wrapIndex(i, n)]; };
  const auto isKnown = [&](int i) { return known[wrapIndex(i, n)] != 0; };
  int last = first;
  const int stop = closed ? first + n : n - 1;
  for (int i = first + 1; i <= stop; ++i) {
    if (!isKnown(i)) continue;
    for (int k = last + 1; k < i; ++k) {
      const float t = static_cast<float>(k - last) / static_cast<float>(i - last);
      at(k) = (1.0f - t) * at(last) + t * at(i);
    }
    last = i;
  }
  if (closed) return;
  for (int k = 0; k < first; ++k) at(k) = at(first);
  for (int k = last + 1; k < n; ++k) at(k) = at(last);
}

}  // namespace

CourseApproach approachAt(const StrokeCourse& c, int border, int side, double reach) {
  const int n = static_cast<int>(c.base.size());
  std::vector<double> s;
  std::vector<Vec2> at;
  for (int k = 0; k <= static_cast<int>(reach); ++k) {
    int i = border + side * k;
    if (c.closed) i = wrapIndex(i, n);
    if (i < 0 || i >= n || c.part[i] == StrokePart::Junction) break;
    s.push_back(side * k);
    at.push_back(c.base[i]);
  }
  CourseApproach a;
  if (at.size() < 3) return a;
  const LocalQuadratic fit = fitLocalQuadratic(s, at, {}, static_cast<double>(at.size()) >= 0.6 * reach ? 2 : 1);
  if (fit.order < 1 || !(fit.r1.norm() > 0.0)) return a;
  return {fit.r0, fit.r1 / fit.r1.norm(), fit.r2, true};
}

StrokeCourse resample(const StrokePath& path) {
  StrokeCourse course;
  course.closed = path.closed;
  course.tip[0] = path.tip[0];
  course.tip[1] = path.tip[1];
  course.widthPx = path.widthPx();
  if (path.points.empty()) return course;
  // A light smoothing takes the stairs of the pixels, so that the length and with it the steps come out even.
  resample(smoothPolyline(positions(path.points), path.closed, 1.5), path.points, course);
  course.base = smoothPolyline(course.chain, course.closed, std::max(2.0, 0.5 * course.widthPx));
  course.tangent = directions(course.base, course.closed, kTangentReach);
  const auto n = course.base.size();
  course.shift.assign(n, 0.0f);
  course.measuredWidth = course.radius;
  for (float& w : course.measuredWidth) w = std::max(1.0f, 2.0f * w);
  course.measured.assign(n, 0);
  course.tone.assign(n, {});
  std::vector<float> radius = course.radius;
  const double high = elementOfRank(radius, static_cast<std::ptrdiff_t>(radius.size() * 9 / 10));
  course.profileHalf = static_cast<int>(std::lround((std::max(high, 0.5 * course.widthPx) + 3.5) / kStrokeStepPx));
  return course;
}

void rejectImplausibleShifts(StrokeCourse& c, bool checkWidth) {
  const auto n = c.base.size();
  std::vector<float> widths;
  for (std::size_t i = 0; i < n; ++i) {
    if (c.measured[i] && c.part[i] == StrokePart::Ink) widths.push_back(c.measuredWidth[i]);
  }
  const double median = medianOf(std::move(widths));
  for (std::size_t i = 0; i < n; ++i) {
    const double w = checkWidth ? c.measuredWidth[i] : median;
    // A pen's width changes slowly: against the mask at the place as well as against the whole.
    const double local = std::max(1.0, 2.0 * static_cast<double>(c.radius[i]));
    const bool plausible = std::abs(w - median) <= 0.4 * median || std::abs(w - local) <= 0.25 * local;
    const bool near = std::abs(c.shift[i]) <= std::max(1.0, 0.5 * local);
    if (c.part[i] != StrokePart::Ink || !plausible || !near) c.measured[i] = 0;
  }
  fillBetween(c.shift, c.measured, c.closed, 0.0f);
  std::vector<std::uint8_t> known = c.measured;
  fillBetween(c.measuredWidth, known, c.closed, static_cast<float>(c.widthPx));
}

void moveCourse(StrokeCourse& c, bool again) {
  for (std::size_t i = 0; i < c.base.size(); ++i) {
    c.base[i] += static_cast<double>(c.shift[i]) * leftNormal(c.tangent[i]);
    c.shift[i] = 0.0f;
  }
  if (!again) return;
  c.base = smoothPolyline(c.base, c.closed, 1.5);
  c.tangent = directions(c.base, c.closed, kTangentReach);
}

void layThroughJunctions(StrokeCourse& c) {
  const int n = static_cast<int>(c.base.size());
  const auto isJunction = [&](int i) { return c.part[wrapIndex(i, n)] == StrokePart::Junction; };
  int start = 0;
  while (c.closed && start < n && isJunction(start)) ++start;
  if (start == n) return;
  const double reach = std::max(8.0, 4.0 * c.widthPx);
  for (int i = start; i < start + n; ++i) {
    if (!isJunction(i)) continue;
    int end = i;
    while (end + 1 < start + n && isJunction(end + 1)) ++end;
    const bool openStart = !c.closed && i == 0, openEnd = !c.closed && end == n - 1;
    const CourseApproach before = openStart ? CourseApproach{} : approachAt(c, i - 1, -1, reach);
    const CourseApproach after = openEnd ? CourseApproach{} : approachAt(c, end + 1, 1, reach);
    std::vector<Vec2> laid(end - i + 1);
    const int count = end - i + 1;
    bool fair = true;
    for (int k = 0; k < count && fair; ++k) {
      Vec2& at = laid[k];
      if (before.ok && after.ok) {
        const double t = static_cast<double>(k + 1) / (count + 1), u = 1.0 - t, length = (after.at - before.at).norm();
        at = u * u * (1.0 + 2.0 * t) * before.at + t * t * (1.0 + 2.0 * u) * after.at +
             length * t * u * (u * before.direction - t * after.direction);
      } else if (before.ok && openEnd) {
        at = before.at + (k + 1) * before.direction;
      } else if (after.ok && openStart) {
        at = after.at - (count - k) * after.direction;
      } else {
        fair = false;
        break;
      }
      // A course that leaves the ink is no course of the pen.
      fair = (at - c.base[wrapIndex(i + k, n)]).norm() <= 0.6 * c.widthPx + 1.0;
    }
    for (int k = 0; k < count && fair; ++k) {
      c.base[wrapIndex(i + k, n)] = laid[k];
    }
    i = end;
  }
}

}  // namespace batten
