// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/ends/stroke_ends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/statistics.h"
#include "core/contour/centreline/ends/end_shape.h"
#include "core/contour/centreline/ends/taper.h"
#include "core/contour/centreline/profile/stroke_course.h"
#include "core/contour/centreline/profile/stroke_profile.h"

namespace batten {
namespace {

constexpr int kFewestEndPoints = 8;        // of a stroke whose ends can be told from its middle
constexpr double kFarthestEatenPx = 30.0;  // what the mask may have lost of a thin stroke, besides two widths
constexpr double kCertain = 50.0;          // [nats]
constexpr double kSameContrast = 0.6;      // of the stroke's contrast: less is another stroke, or paper
constexpr double kSameWider = 1.4, kSameNarrower = 0.6;  // of its width
constexpr double kEndSteering = 0.5;                     // of the step aside: the noise of a pixel counts half
constexpr double kLargestSidestepPx = 0.75;              // from one pixel to the next
constexpr double kLargestTurnRad = 0.5;                  // 30 degrees
constexpr double kRoundEndWidths = 0.06;  // [stroke widths] the half level over the middle half of a round end lies
                                          // so much before its tip
constexpr double kAnchorWidths = 1.5;     // [stroke widths] and
constexpr double kAnchorPx = 3.0;         // [px] inside, from where an end is seen; of thin strokes the hook is px long
constexpr double kEndApproachWidths = 4.0;   // [stroke widths] over which the course towards an end is fitted,
constexpr double kLeastEndApproachPx = 8.0;  // and of thin strokes: over less, a parabola follows the steps of pixels
constexpr double kCornerWidths = 0.3;        // [stroke widths] a course into a corner is longer than the stroke
constexpr double kOffCourseWidths = 0.15;    // [stroke widths] between a course and its parabola
constexpr double kTurnsAsideWidths = 0.75;   // [stroke widths] before the end of the ink a course may turn to a corner
constexpr double kSkeletonOffWidths = 0.6;   // [stroke widths]
constexpr double kLeastStepPx = 0.35;        // between neighbours on a contour, of about 1 px
constexpr float kLeastWidthPx = 0.1f;        // a point of a stroke has some width

std::optional<StrokeCentre> centreAt(const StrokeCourse& c, const Vec2& at, const Vec2& direction,
                                     const GreyImage& grey) {
  const std::vector<float> profile = profileAcross(grey, at, direction, c.profileHalf);
  std::vector<float> scratch(profile.size());
  return halfLevelCentre(profile, c.widthPx, scratch);
}

// Smoothing a mask eats the ends of thin strokes: follows the ink on the grey values from the end of the skeleton on,
// as long as it stays this stroke (about its width and darkness, no turn).
void followInk(StrokeCourse& c, const GreyImage& grey) {
  const double w = c.widthPx, farthest = kFarthestEatenPx + 2.0 * w;
  const int back = std::max(kLeastBackPoints, static_cast<int>(std::lround(w)));
  const int n = c.count();
  const int hook = std::min(n - back - 2, static_cast<int>(std::ceil(kHookWidths * w)));
  if (hook < 1) return;
  std::vector<Vec2> path;
  for (int i = n - hook - back - 1; i < n - hook; ++i) path.push_back(c.points[i].base);
  const auto direction = [&] { return Vec2((path.back() - path[std::ssize(path) - 1 - back]).normalized()); };
  const std::optional<StrokeCentre> here = centreAt(c, path.back(), direction(), grey);
  if (!here) return;
  const auto known = std::ssize(path);
  while (static_cast<double>(std::ssize(path) - known) < farthest) {
    const Vec2 d = direction(), at = path.back() + d;
    const std::optional<StrokeCentre> next = centreAt(c, at, d, grey);
    const bool same = next && next->contrast > kSameContrast * here->contrast &&
                      next->width < kSameWider * here->width + 0.5 && next->width > kSameNarrower * here->width &&
                      std::abs(next->centre) < kLargestSidestepPx;
    if (!same) break;
    path.push_back(at + kEndSteering * next->centre * leftNormal(d));
  }
  if (static_cast<double>(std::ssize(path) - known) < hook + 1.0) return;
  replaceTail(c, n - hook, {path.begin() + known, path.end()});
}

void reverseCourse(StrokeCourse& c) {
  std::reverse(c.points.begin(), c.points.end());
  for (CoursePoint& p : c.points) p.tangent = -p.tangent;
  std::swap(c.tip[0], c.tip[1]);
}

// [px] The width of the stroke where its half levels tell, else that of the mask, which is up to a pixel off.
double endWidth(const StrokeCourse& c) {
  std::vector<float> widths;
  for (const CoursePoint& p : c.points) {
    if (p.measured && p.part == StrokePart::Ink) widths.push_back(p.measuredWidth);
  }
  return widths.empty() ? c.widthPx : static_cast<double>(upperMedian(widths));
}

// Whether a course runs as the parabola says, as far as the end of the ink that was seen along it. A skeleton ends
// within a pixel or two of the pen's last place or in a corner of the end; a stroke that turns is left sideways.
bool runsAlong(const StrokeCourse& c, const FreeEnd& found) {
  const double w = found.widthPx, off = kSkeletonOffWidths * w + 2.0;
  const double reached = (c.points.back().base - found.course.at).dot(found.course.out);
  if (std::abs(found.tipPx - 0.5 * w - reached) > off) return false;
  if (found.inside < found.tipPx - 0.5 * w - off || found.inside > found.tipPx + kCornerWidths * w + 2.0) return false;
  const int anchor = c.count() - 1 - found.inside;
  const int straight = std::min(found.inside, static_cast<int>(found.tipPx - kTurnsAsideWidths * w - 1.0));
  const double most = std::max(1.0, kOffCourseWidths * w);
  for (int k = 0; k <= straight; ++k) {
    if ((c.points[anchor + k].base - found.course.position(k)).norm() > most) return false;
  }
  return true;
}

// The last end of a course as seen from so many points inside; nothing where none is seen.
std::optional<FreeEnd> endSeenFrom(const StrokeCourse& c, int inside, double w, const GreyImage& grey) {
  FreeEnd found;
  found.inside = inside;
  found.widthPx = w;
  const auto a = approachAt(c, c.count() - 1 - inside, -1, std::max(kLeastEndApproachPx, kEndApproachWidths * w));
  if (!a) return std::nullopt;
  found.course = {a->at, a->direction, a->bend};
  // No turn of more than about 30 degrees is read from a parabola beyond its points.
  const double most = kLargestTurnRad / (inside + w);
  if (found.course.bend.norm() > most) found.course.bend *= most / found.course.bend.norm();
  const std::optional<double> tip = inkEnd(found.course, w, inside, grey);
  if (!tip) return std::nullopt;
  found.tipPx = *tip;
  return runsAlong(c, found) ? std::optional(found) : std::nullopt;
}

// The last end of a course, looked at. From so far inside that the direction is still that of the stroke: before a wide
// end is cut off the skeleton leaves its middle for a corner, and the smoothing spreads that. From nearer where the
// stroke turns.
std::optional<FreeEnd> lastEnd(const StrokeCourse& c, const GreyImage& grey) {
  const double w = endWidth(c);
  for (const double widths : {kAnchorWidths, 1.0}) {
    const int inside = std::min(c.count() / 2, static_cast<int>(std::lround(widths * w + kAnchorPx)));
    std::optional<FreeEnd> found = endSeenFrom(c, inside, w, grey);
    if (!found) continue;
    found->stop = penStop(found->course, w, found->tipPx, grey);
    return found;
  }
  return std::nullopt;
}

// Ends the course where the pen stopped.
void placeLast(StrokeCourse& c, const FreeEnd& found, double cutOdds) {
  const double w = found.widthPx;
  const double stop = std::max(0.0, found.stop ? found.stop->at(cutOdds) : found.tipPx + kRoundEndWidths * w - 0.5 * w);
  const int anchor = std::max(0, c.count() - 1 - found.inside), inside = c.count() - 1 - anchor;
  // The last half width of a skeleton turns to one corner of the pen's end.
  const double straight = std::min(inside - std::ceil(kHookWidths * w), found.tipPx - kTurnsAsideWidths * w - 1.0);
  const int kept = std::clamp(static_cast<int>(std::min(stop - 0.5, straight)), 0, inside);
  const Vec2 offset = c.points[anchor + kept].base - found.course.position(kept);
  const int count = std::max(0, static_cast<int>(std::lround(stop - kept)));
  std::vector<Vec2> tail;
  for (int k = 1; k <= count; ++k) tail.push_back(found.course.position(kept + (stop - kept) * k / count) + offset);
  replaceTail(c, anchor + kept + 1, tail);
}

// Standard deviations of the points. Those that only the half levels of their profile have placed are known half as
// well as those next to them.
void addSigmas(Contour& contour, std::vector<std::optional<PointInformation>> information) {
  const auto known = std::find_if(information.begin(), information.end(), [](const auto& i) { return i.has_value(); });
  std::optional<double> gain;
  if (known != information.end()) gain = (*known)->gain;
  for (int i = 0; i < std::ssize(information); ++i) {
    std::optional<PointInformation>& here = information[i];
    const bool isPlaced = contour.points[i].refined;
    if (here) {
      gain = here->gain;
    } else if (isPlaced && gain) {
      here = {.gain = 2.0 * *gain};
    }
    if (!isPlaced) here.reset();
  }
  const std::vector<float> sigma = pointSigmas(information, contour.closed);
  for (int i = 0; i < std::ssize(sigma); ++i) contour.points[i].sigmaPx = sigma[i];
}

}  // namespace

FreeEnds findEnds(StrokeCourse& c, const GreyImage& grey, bool isPencil) {
  FreeEnds ends;
  if (c.closed || c.count() < kFewestEndPoints) return ends;
  const auto find = [&](int side) {
    followInk(c, grey);
    if (isPencil || !reachTaperTip(c, grey)) ends[side] = lastEnd(c, grey);
  };
  if (c.tip[1]) find(1);
  if (!c.tip[0]) return ends;
  reverseCourse(c);
  find(0);
  reverseCourse(c);
  return ends;
}

double cutOddsOf(const std::vector<FreeEnds>& ends) {
  std::vector<double> evidence;
  for (const FreeEnds& both : ends) {
    for (const std::optional<FreeEnd>& end : both) {
      if (end && end->stop) evidence.push_back(end->stop->forCut);
    }
  }
  // The share of cut ends that makes what was seen most likely.
  constexpr int kShares = 100;
  double best = 0.0, most = -std::numeric_limits<double>::infinity();
  for (int k = 1; k < kShares; ++k) {
    const double share = static_cast<double>(k) / kShares;
    double likely = std::log(share * (1.0 - share));  // none and all are less likely before anything is seen
    for (const double e : evidence) likely += std::log(share * std::exp(std::min(e, kCertain)) + 1.0 - share);
    if (likely > most) {
      most = likely;
      best = std::log(share / (1.0 - share));
    }
  }
  return best;
}

void placeEnds(StrokeCourse& c, const FreeEnds& ends, double cutOdds) {
  if (ends[1]) placeLast(c, *ends[1], cutOdds);
  if (!ends[0]) return;
  reverseCourse(c);
  placeLast(c, *ends[0], cutOdds);
  reverseCourse(c);
}

Contour contourOf(const StrokeCourse& c) {
  Contour contour;
  contour.kind = ContourKind::Centreline;
  contour.closed = c.closed;
  if (!c.closed) contour.endsInInk = {!c.tip[0], !c.tip[1]};
  std::vector<CoursePoint> kept;
  for (const CoursePoint& p : c.points) {
    if (!kept.empty()) {
      // Never back: where a tight turn folded the course, its points go.
      const Vec2 step = p.base - kept.back().base;
      if (step.norm() < kLeastStepPx || step.dot(p.tangent) < 0.0) continue;
    }
    kept.push_back(p);
  }
  while (contour.closed && kept.size() > 3 && (kept.front().base - kept.back().base).norm() < kLeastStepPx) {
    kept.pop_back();
  }
  std::vector<std::optional<PointInformation>> information;
  for (const CoursePoint& p : kept) {
    contour.points.push_back({.at = p.base,
                              .unrefined = p.chain,
                              .refined = p.measured,
                              .widthPx = std::max(kLeastWidthPx, p.measuredWidth)});
    information.push_back(p.information);
  }
  if (c.wasPlacedOnPixels) addSigmas(contour, std::move(information));
  const int n = static_cast<int>(kept.size());
  for (int i = 0; i < n; ++i) {
    if (kept[i].part != StrokePart::Bridge) continue;
    int last = i;
    while (last + 1 < n && kept[last + 1].part == StrokePart::Bridge) ++last;
    contour.bridges.emplace_back(i, last);
    i = last;
  }
  measureContour(contour);
  return contour;
}

}  // namespace batten
