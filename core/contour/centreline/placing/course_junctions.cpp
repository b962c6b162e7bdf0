// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/placing/course_junctions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kApproachWidths = 4.0;    // [stroke widths] looked at on either side of a junction,
constexpr double kLeastApproachPx = 8.0;   // and of thin strokes
constexpr double kOffInkWidths = 0.6;      // [stroke widths] a course farther than this, and a pixel, has left the ink
constexpr double kBlotWidths = 4.0;        // [stroke widths] length of the longest blot
constexpr double kBlotBroader = 1.4;       // times the stroke beside it
constexpr double kBlotBegins = 1.1;        // times the stroke beside it, too
constexpr double kBlotBesideWidths = 0.5;  // [stroke widths]
constexpr double kRadiusOffPx = 0.75;      // by the pixels
constexpr double kBlotTurnRad = std::numbers::pi / 4.5;  // a sharper turn is a corner, which is broad inside
constexpr double kSameWayRad = std::numbers::pi / 6.0;   // the sides of a crossing that only steps aside
constexpr double kGentleSlant = 0.15;                    // [tangent] of a crossing
constexpr double kMostCrossWidths = 4.0;                 // [stroke widths] that a crossing may be long to either side
constexpr double kJogSine = 0.2;  // of the angle to the course as seen from a width to either side
constexpr double kLeastJogWidths = 0.15, kLeastJogPx = 0.5;  // aside at the least
constexpr double kJogOffWidths = 0.35;                       // [stroke widths] that a jog is left by at the most

double reachOf(const StrokeCourse& c) { return std::max(kLeastApproachPx, kApproachWidths * c.widthPx); }

// Radii with every peak cut off that is shorter than `length` points: each is the highest level that a stretch of this
// length around it keeps.
std::vector<float> withoutPeaks(const std::vector<float>& radius, bool closed, int length) {
  const int n = static_cast<int>(radius.size()), stretches = closed ? n : n - length + 1;
  std::vector<float> lowest(std::max(0, stretches)), cut = radius;
  for (int i = 0; i < stretches; ++i) {
    lowest[i] = radius[i];
    for (int k = 1; k < length; ++k) lowest[i] = std::min(lowest[i], radius[wrapIndex(i + k, n)]);
  }
  for (int i = 0; i < n; ++i) {
    bool any = false;
    float best = 0.0f;
    for (int k = 0; k < length; ++k) {
      const int from = closed ? wrapIndex(i - k, n) : i - k;
      if (from < 0 || from >= stretches) continue;
      best = any ? std::max(best, lowest[from]) : lowest[from];
      any = true;
    }
    if (any) cut[i] = best;
  }
  return cut;
}

// A stretch of points within a junction, and what the stroke does on either side of it.
struct JunctionStretch {
  int begin = 0, end = 0;  // may pass the end of a closed course
  std::optional<CourseApproach> before, after;
};

bool isJunction(const StrokeCourse& c, int i) { return c.points[wrapIndex(i, c.count())].part == StrokePart::Junction; }

JunctionStretch between(const StrokeCourse& c, int begin, int end, bool onlyOutside = true) {
  JunctionStretch crossing{begin, end, {}, {}};
  if (c.closed || begin > 0) crossing.before = approachAt(c, begin - 1, -1, reachOf(c), onlyOutside);
  if (c.closed || end + 1 < c.count()) crossing.after = approachAt(c, end + 1, 1, reachOf(c), onlyOutside);
  return crossing;
}

JunctionStretch crossingAt(const StrokeCourse& c, int begin, int last) {
  int end = begin;
  while (end + 1 <= last && isJunction(c, end + 1)) ++end;
  return between(c, begin, end);
}

// Whether a stroke goes on beyond a crossing as before it, but for a turn of less than this.
bool continuesWithin(const JunctionStretch& crossing, double turnRad) {
  return crossing.before && crossing.after &&
         crossing.before->direction.dot(crossing.after->direction) >= std::cos(turnRad);
}

// Tangent of the angle at which a crossing leaves the mean direction of its sides; nothing where these turn.
std::optional<double> slantOf(const JunctionStretch& crossing) {
  if (!continuesWithin(crossing, kSameWayRad)) return std::nullopt;
  const Vec2 along = (crossing.before->direction + crossing.after->direction).normalized();
  const Vec2 chord = crossing.after->at - crossing.before->at;
  const double length = chord.dot(along);
  if (!(length > 0.0)) return std::nullopt;
  return std::abs(cross(along, chord)) / length;
}

double radiusAt(const StrokeCourse& c, int i) { return static_cast<double>(c.points[wrapIndex(i, c.count())].radius); }

// Whether a place is within the ink of a point by at least half the width of the stroke; a course that leaves the ink
// is no course of the pen.
bool isOnInk(const StrokeCourse& c, int i, const Vec2& at, double offWidths) {
  const double free = radiusAt(c, i) - 0.5 * c.widthPx;
  return (at - c.points[wrapIndex(i, c.count())].base).norm() <= std::max(offWidths * c.widthPx, free) + 1.0;
}

// Places of the points of a crossing on a cubic that continues both sides, or straight on where there is one; nothing
// where they leave the ink.
std::optional<std::vector<Vec2>> courseThrough(const StrokeCourse& c, const JunctionStretch& x, double offWidths) {
  const int count = x.end - x.begin + 1;
  const bool isOpenStart = !c.closed && x.begin == 0, isOpenEnd = !c.closed && x.end == c.count() - 1;
  const bool isBetween = x.before && x.after;
  const double derivative =
      isBetween ? endDerivative((x.after->at - x.before->at).norm(), x.before->direction, x.after->direction) : 0.0;
  std::vector<Vec2> places(count);
  for (int k = 0; k < count; ++k) {
    Vec2& at = places[k];
    if (isBetween) {
      const double t = static_cast<double>(k + 1) / (count + 1), u = 1.0 - t;
      at = u * u * (1.0 + 2.0 * t) * x.before->at + t * t * (1.0 + 2.0 * u) * x.after->at +
           derivative * t * u * (u * x.before->direction - t * x.after->direction);
    } else if (x.before && isOpenEnd) {
      at = x.before->at + (k + 1) * x.before->direction;
    } else if (x.after && isOpenStart) {
      at = x.after->at - (count - k) * x.after->direction;
    } else {
      return std::nullopt;
    }
    if (!isOnInk(c, x.begin + k, at, offWidths)) return std::nullopt;
  }
  return places;
}

void layOver(StrokeCourse& c, const JunctionStretch& crossing, const std::vector<Vec2>& places) {
  for (int k = 0; k < std::ssize(places); ++k) c.points[wrapIndex(crossing.begin + k, c.count())].base = places[k];
}

// Sine of the angle at which a course goes at a point, against its course from `reach` points before to as many behind.
double slantAt(const StrokeCourse& c, int i, int reach, int near) {
  const auto at = [&](int k) -> const Vec2& { return c.points[wrapIndex(k, c.count())].base; };
  const Vec2 here = at(i + near) - at(i - near), around = at(i + reach) - at(i - reach);
  const double length = here.norm() * around.norm();
  return length > 0.0 ? std::abs(cross(here, around)) / length : 0.0;
}

// Lays a gentle course over a jog, as short a one as there is. Where the sides lie aside of each other by less it may
// be the noise of the page, which the fit weighs.
void removeJog(StrokeCourse& c, int at, int reach) {
  const int n = c.count(), most = static_cast<int>(std::lround(kMostCrossWidths * c.widthPx));
  const double leastAsidePx = kLeastJogWidths * c.widthPx + kLeastJogPx;
  for (int half = reach; half <= most; ++half) {
    const int begin = at - half, end = at + half;
    if (c.closed ? 2 * (half + reach) > n : begin < reach || end >= n - reach) return;
    const JunctionStretch crossing = between(c, begin, end, false);
    const std::optional<double> slant = slantOf(crossing);
    if (!slant || *slant > kGentleSlant) continue;
    if (*slant * (crossing.after->at - crossing.before->at).norm() < leastAsidePx) continue;
    const auto places = courseThrough(c, crossing, kJogOffWidths);
    if (!places) continue;
    layOver(c, crossing, *places);  // as well known as its sides: the points count as placed
    return;
  }
}

}  // namespace

void hideBlots(StrokeCourse& c) {
  const int n = c.count(), length = static_cast<int>(std::lround(kBlotWidths * c.widthPx));
  if (n < 2 * length || length < 3) return;
  const std::vector<float> radius = valuesOf(c, &CoursePoint::radius);
  const auto broadest = static_cast<double>(*std::max_element(radius.begin(), radius.end()));
  if (broadest <= kBlotBroader * 0.5 * c.widthPx + kRadiusOffPx) return;
  const std::vector<float> cut = withoutPeaks(radius, c.closed, length);
  // Where a skeleton turns to the tip of a corner its radius falls: what lies between two of these is no blot.
  const auto isBroader = [&](int i, double times) {
    return static_cast<double>(radius[i]) >
           times * std::max(static_cast<double>(cut[i]), 0.5 * c.widthPx) + kRadiusOffPx;
  };
  for (int i = 1; i + 1 < n; ++i) {
    if (!isBroader(i, kBlotBroader)) continue;
    int begin = i, end = i;
    while (begin > 0 && isBroader(begin - 1, kBlotBegins)) --begin;
    while (end + 1 < n && isBroader(end + 1, kBlotBegins)) ++end;
    i = end;
    // Profiles are averaged along the stroke: the blot is seen beside it, too.
    const int beside = static_cast<int>(std::lround(kBlotBesideWidths * c.widthPx));
    begin -= beside;
    end += beside;
    if (begin <= 0 || end + 1 >= n) continue;
    const auto isInk = [](const CoursePoint& p) { return p.part == StrokePart::Ink; };
    if (!std::all_of(c.points.begin() + begin - 1, c.points.begin() + end + 2, isInk)) continue;
    if (!continuesWithin(between(c, begin, end), kBlotTurnRad)) continue;
    for (int k = begin; k <= end; ++k) c.points[k].part = StrokePart::Junction;
  }
}

void layThroughJunctions(StrokeCourse& c) {
  const int n = c.count();
  int start = 0;
  while (c.closed && start < n && isJunction(c, start)) ++start;
  if (start == n) return;
  for (int i = start; i < start + n; ++i) {
    if (!isJunction(c, i)) continue;
    const JunctionStretch crossing = crossingAt(c, i, start + n - 1);
    if (const auto places = courseThrough(c, crossing, kOffInkWidths)) layOver(c, crossing, *places);
    i = crossing.end;
  }
}

void removeJogs(StrokeCourse& c) {
  const int n = c.count(), reach = std::max(3, static_cast<int>(std::lround(c.widthPx)));
  const int near = std::max(2, static_cast<int>(std::lround(0.25 * c.widthPx)));
  if (n < 4 * reach) return;
  const int first = c.closed ? 0 : 2 * reach, last = c.closed ? n - 1 : n - 1 - 2 * reach;
  for (int i = first; i <= last; ++i) {
    if (slantAt(c, i, reach, near) < kJogSine) continue;
    int worst = i;
    for (int k = i; k <= std::min(last, i + reach); ++k)
      if (slantAt(c, k, reach, near) > slantAt(c, worst, reach, near)) worst = k;
    i = worst + reach;
    removeJog(c, worst, reach);
  }
}

}  // namespace batten
