// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/stroke_ends.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/statistics.h"
#include "core/contour/centreline/stroke_course.h"
#include "core/contour/centreline/stroke_profile.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kFewestEndPoints = 8;        // of a stroke whose ends can be told from its middle
constexpr double kFarthestEatenPx = 30.0;  // what the mask may have lost of a thin stroke, besides two widths
constexpr int kLeastBackPoints = 4;        // over which the direction of an end is taken
constexpr double kHookWidths = 0.5;        // [stroke widths] the end of a skeleton turns to a corner of the ink there
constexpr double kSameContrast = 0.6;      // of the stroke's contrast: less is another stroke, or paper
constexpr double kSameWider = 1.4, kSameNarrower = 0.6;  // of its width
constexpr double kLargestSidestepPx = 0.75;              // from one pixel to the next
constexpr double kLargestTurnRad = 0.5;                  // 30 degrees
constexpr double kRoundEndWidths = 0.06;    // [stroke widths] the half level over the middle half of a round end lies
                                            // so much before its tip
constexpr double kSkeletonOffWidths = 0.6;  // [stroke widths]
constexpr float kEndContrast = 4.0f;        // [grey]
constexpr double kLeastStepPx = 0.35;       // between neighbours on a contour, of about 1 px
constexpr float kLeastWidthPx = 0.1f;

// The course near its end, going on beyond it as a parabola; s = 0 at the anchor, growing outwards.
struct EndCourse {
  Vec2 at = Vec2::Zero(), out = Vec2::Zero(), bend = Vec2::Zero();
  Vec2 position(double s) const { return at + s * out + 0.5 * s * s * bend; }
};

// [px] beyond the anchor where the ink ends: the half level of the mean over the middle half of the stroke.
std::optional<double> inkEnd(const EndCourse& end, double widthPx, double inside, const GreyImage& grey) {
  const double farthest = inside + 2.0 * widthPx + 3.0;
  const int samples = static_cast<int>(farthest / kStrokeStepPx) + 1;
  const int lanes = std::max(1, static_cast<int>(std::lround(0.5 * widthPx)));
  std::vector<float> level(samples, 0.0f);
  for (int k = 0; k < samples; ++k) {
    const double s = k * kStrokeStepPx;
    const Vec2 normal = leftNormal(end.out + s * end.bend).normalized();
    for (int j = -lanes; j <= lanes; ++j) {
      const Vec2 at = end.position(s) + (0.25 * widthPx * j / lanes) * normal;
      level[k] += sampleGrey(grey, at.x(), at.y()) / static_cast<float>(2 * lanes + 1);
    }
  }
  std::vector<float> inner(level.begin(),
                           level.begin() + std::clamp(static_cast<int>(0.5 * inside / kStrokeStepPx), 1, samples));
  const float ink = upperMedian(inner);
  const float paper = *std::max_element(level.begin(), level.end());
  const float middle = 0.5f * (ink + paper);
  if (!(paper - ink > kEndContrast)) return std::nullopt;
  for (int k = 0; k + 1 < samples; ++k) {
    const float a = level[k], b = level[k + 1];
    if (a < middle && b >= middle) return (k + (middle - a) / (b - a)) * kStrokeStepPx;
  }
  return std::nullopt;
}

// Keeps `keep` points and appends `tail`; what is not known of the new points is as at the last one kept.
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

// Profile at a place, averaged over 3 px along the direction.
std::optional<StrokeCentre> centreAt(const StrokeCourse& c, const Vec2& at, const Vec2& direction,
                                     const GreyImage& grey) {
  const int samples = 2 * c.profileHalf + 1;
  std::vector<float> mean(samples, 0.0f), scratch(samples);
  const Vec2 normal = leftNormal(direction);
  for (int d = -1; d <= 1; ++d) {
    for (int k = 0; k < samples; ++k) {
      const double u = (k - c.profileHalf) * kStrokeStepPx;
      const Vec2 p = at + d * direction + u * normal;
      mean[k] += sampleGrey(grey, p.x(), p.y()) / 3.0f;
    }
  }
  return halfLevelCentre(mean, c.widthPx, scratch);
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
    path.push_back(at + 0.5 * next->centre * leftNormal(d));
  }
  if (static_cast<double>(std::ssize(path) - known) < hook + 1.0) return;
  replaceTail(c, n - hook, {path.begin() + known, path.end()});
}

void turnRound(StrokeCourse& c) {
  std::reverse(c.points.begin(), c.points.end());
  for (CoursePoint& p : c.points) p.tangent = -p.tangent;
  std::swap(c.tip[0], c.tip[1]);
}

// Ends the course half a pen's width before the end of the ink.
void placeLastPoint(StrokeCourse& c, const GreyImage& grey) {
  const int n = c.count();
  const double w = c.widthPx;
  // From a place about a width inside, where the direction is still that of the stroke.
  const int inside = std::min(n / 2, static_cast<int>(std::lround(w + 3.0)));
  const int anchor = n - 1 - inside;
  const auto a = approachAt(c, anchor, -1, std::max(8.0, 4.0 * w));
  if (!a) return;
  EndCourse end{a->at, a->direction, a->bend};
  // No turn of more than about 30 degrees is read from a parabola beyond its points.
  const double most = kLargestTurnRad / (inside + w);
  if (end.bend.norm() > most) end.bend *= most / end.bend.norm();
  const std::optional<double> tip = inkEnd(end, w, inside, grey);
  if (!tip) return;
  const double stop = std::max(0.0, *tip + kRoundEndWidths * w - 0.5 * w);
  // A skeleton ends within a pixel or two of the pen's last place; farther off, the parabola has left the stroke.
  if (std::abs(stop - inside) > kSkeletonOffWidths * w + 2.0) return;
  // The last half width of a skeleton turns to one corner of the pen's end.
  const int kept = std::clamp(
      std::min(static_cast<int>(stop - 0.5), inside - static_cast<int>(std::ceil(kHookWidths * w))), 0, inside);
  const Vec2 offset = c.points[anchor + kept].base - end.position(kept);
  const int count = std::max(0, static_cast<int>(std::lround(stop - kept)));
  std::vector<Vec2> tail;
  for (int k = 1; k <= count; ++k) tail.push_back(end.position(kept + (stop - kept) * k / count) + offset);
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

void placeEnds(StrokeCourse& c, const GreyImage& grey) {
  if (c.closed || c.count() < kFewestEndPoints) return;
  const auto place = [&] {
    followInk(c, grey);
    placeLastPoint(c, grey);
  };
  if (c.tip[1]) place();
  if (!c.tip[0]) return;
  turnRound(c);
  place();
  turnRound(c);
}

Contour contourOf(const StrokeCourse& c) {
  Contour contour;
  contour.kind = ContourKind::Centreline;
  contour.closed = c.closed;
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
