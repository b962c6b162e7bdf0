// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/profile/stroke_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/centreline/profile/stroke_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kWidePercent = 90;           // of the points are no wider than the profile is made for
constexpr int kTangentReach = 2;           // points to either side
constexpr double kCourseStairSigma = 1.5;  // points: the stairs of the pixels are about three long
constexpr double kLeastBaseSigma = 2.0;    // points: thin strokes wander by as much from pixel to pixel
constexpr double kMostOfRing = 0.06;       // of its length: a ring shrinks by 7 % then
constexpr double kPaperBesidePx = 3.5;     // beyond the border of the ink: two px of blur, and paper to measure
constexpr double kParabolaShare = 0.6;     // of the reach: over less only a line is fitted
constexpr double kWidthOffMedian = 0.4;    // of the median width of the stroke
constexpr double kWidthOffMask = 0.25;     // of the width in the mask at the place

std::vector<Vec2> positions(const std::vector<StrokePathPoint>& points) {
  std::vector<Vec2> at;
  at.reserve(points.size());
  for (const StrokePathPoint& p : points) at.push_back(p.at);
  return at;
}

// The stroke path at even steps of about 1 px. Parts go to the nearest old point.
void resample(const std::vector<Vec2>& at, const std::vector<StrokePathPoint>& points, StrokeCourse& course) {
  const int n = static_cast<int>(at.size());
  std::vector<double> s = cumulativeLength(at);
  const double total = s.back() + (course.closed ? (at.front() - at.back()).norm() : 0.0);
  const int steps = std::max(course.closed ? 4 : 1, static_cast<int>(std::lround(total)));
  const int count = course.closed ? steps : steps + 1;
  int k = 0;
  for (int i = 0; i < count; ++i) {
    const double want = total * i / steps;
    while (k + 1 < n && s[k + 1] < want) ++k;
    const int next = k + 1 < n ? k + 1 : (course.closed ? 0 : k);
    const double span = (k + 1 < n ? s[k + 1] : total) - s[k];
    const double t = span > 0.0 ? std::clamp((want - s[k]) / span, 0.0, 1.0) : 0.0;
    CoursePoint& p = course.points.emplace_back();
    p.chain = (1.0 - t) * at[k] + t * at[next];
    p.radius = static_cast<float>((1.0 - t) * points[k].radius + t * points[next].radius);
    p.measuredWidth = std::max(1.0f, 2.0f * p.radius);
    p.part = points[t < 0.5 ? k : next].part;
  }
}

float medianOf(std::vector<float> values) {
  if (values.empty()) return 0.0f;
  return upperMedian(values);
}

// Values without a measurement are laid straight between those that have one.
void fillBetween(StrokeCourse& course, float CoursePoint::*value, float otherwise) {
  const int n = course.count();
  const auto isMeasured = [](const CoursePoint& p) { return p.measured; };
  const auto found = std::find_if(course.points.begin(), course.points.end(), isMeasured);
  if (found == course.points.end()) {
    for (CoursePoint& p : course.points) p.*value = otherwise;
    return;
  }
  const auto first = static_cast<int>(found - course.points.begin());
  const auto at = [&](int i) -> float& { return course.points[wrapIndex(i, n)].*value; };
  const auto isKnown = [&](int i) { return course.points[wrapIndex(i, n)].measured; };
  int last = first;
  const int stop = course.closed ? first + n : n - 1;
  for (int i = first + 1; i <= stop; ++i) {
    if (!isKnown(i)) continue;
    for (int k = last + 1; k < i; ++k) {
      const float t = static_cast<float>(k - last) / static_cast<float>(i - last);
      at(k) = (1.0f - t) * at(last) + t * at(i);
    }
    last = i;
  }
  if (course.closed) return;
  for (int k = 0; k < first; ++k) at(k) = at(first);
  for (int k = last + 1; k < n; ++k) at(k) = at(last);
}

}  // namespace

std::optional<CourseApproach> approachAt(const StrokeCourse& c, int border, int side, double reach, bool onlyOutside) {
  const int n = c.count();
  std::vector<double> s;
  std::vector<Vec2> at;
  for (int k = 0; k <= static_cast<int>(reach); ++k) {
    int i = border + side * k;
    if (c.closed) i = wrapIndex(i, n);
    if (i < 0 || i >= n || (onlyOutside && c.points[i].part == StrokePart::Junction)) break;
    s.push_back(side * k);
    at.push_back(c.points[i].base);
  }
  if (at.size() < 3) return std::nullopt;
  const LocalQuadratic fit =
      fitLocalQuadratic(s, at, {}, static_cast<double>(at.size()) >= kParabolaShare * reach ? 2 : 1);
  if (fit.order < 1 || !(fit.r1.norm() > 0.0)) return std::nullopt;
  return CourseApproach{fit.r0, fit.r1 / fit.r1.norm(), fit.r2};
}

StrokeCourse resample(const StrokePath& path) {
  StrokeCourse course;
  course.closed = path.closed;
  course.tip = path.tip;
  course.widthPx = path.widthPx();
  if (path.points.empty()) return course;
  // A light smoothing takes the stairs of the pixels, so that the length and with it the steps come out even.
  resample(smoothPolyline(positions(path.points), path.closed, kCourseStairSigma), path.points, course);
  double sigma = std::max(kLeastBaseSigma, 0.5 * course.widthPx);
  if (course.closed) sigma = std::min(sigma, kMostOfRing * course.count());
  const std::vector<Vec2> base = smoothPolyline(valuesOf(course, &CoursePoint::chain), course.closed, sigma);
  setValues(course, &CoursePoint::base, base);
  setValues(course, &CoursePoint::tangent, directions(base, course.closed, kTangentReach));
  std::vector<float> radius = valuesOf(course, &CoursePoint::radius);
  const double high = elementOfRank(radius, std::ssize(radius) * kWidePercent / 100);
  course.profileHalf =
      static_cast<int>(std::lround((std::max(high, 0.5 * course.widthPx) + kPaperBesidePx) / kStrokeStepPx));
  return course;
}

void rejectImplausibleShifts(StrokeCourse& c, bool checkWidth) {
  std::vector<float> widths;
  for (const CoursePoint& p : c.points) {
    if (p.measured && p.part == StrokePart::Ink) widths.push_back(p.measuredWidth);
  }
  const double median = medianOf(std::move(widths));
  for (CoursePoint& p : c.points) {
    const double w = checkWidth ? p.measuredWidth : median;
    // A pen's width changes slowly: against the mask at the place as well as against the whole.
    const double local = std::max(1.0, 2.0 * static_cast<double>(p.radius));
    const bool plausible =
        std::abs(w - median) <= kWidthOffMedian * median || std::abs(w - local) <= kWidthOffMask * local;
    const bool near = std::abs(p.shift) <= std::max(1.0, 0.5 * local);
    if (p.part != StrokePart::Ink || !plausible || !near) p.measured = false;
  }
  fillBetween(c, &CoursePoint::shift, 0.0f);
  fillBetween(c, &CoursePoint::measuredWidth, static_cast<float>(c.widthPx));
}

void moveCourse(StrokeCourse& c, bool again) {
  for (CoursePoint& p : c.points) {
    p.base += static_cast<double>(p.shift) * leftNormal(p.tangent);
    p.shift = 0.0f;
  }
  if (!again) return;
  const std::vector<Vec2> base = smoothPolyline(valuesOf(c, &CoursePoint::base), c.closed, kCourseStairSigma);
  setValues(c, &CoursePoint::base, base);
  setValues(c, &CoursePoint::tangent, directions(base, c.closed, kTangentReach));
}

void replaceTail(StrokeCourse& c, int keep, const std::vector<Vec2>& tail) {
  const std::vector<Vec2> chain = valuesOf(c, &CoursePoint::chain);
  c.points.resize(keep);
  CoursePoint added = c.points.back();
  added.measured = true;
  added.information.reset();
  for (const Vec2& at : tail) {
    const int i = c.count();
    added.base = at;
    added.chain = i < std::ssize(chain) ? chain[i] : at;
    c.points.push_back(added);
  }
}

}  // namespace batten
