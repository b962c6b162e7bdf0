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
  if (!(paper - ink > 4.0f)) return std::nullopt;
  for (int k = 0; k + 1 < samples; ++k) {
    const float a = level[k], b = level[k + 1];
    if (a < middle && b >= middle) return (k + (middle - a) / (b - a)) * kStrokeStepPx;
  }
  return std::nullopt;
}

template <class T>
void resizeTail(std::vector<T>& v, std::size_t keep, std::size_t total) {
  v.resize(keep);
  const T last = v.back();
  v.resize(total, last);
}

// Keeps `keep` points and appends `tail`.
void replaceTail(StrokeCourse& c, std::size_t keep, const std::vector<Vec2>& tail) {
  const std::size_t total = keep + tail.size();
  const std::vector<Vec2> chain = c.chain;
  resizeTail(c.chain, keep, total);
  resizeTail(c.base, keep, total);
  resizeTail(c.tangent, keep, total);
  resizeTail(c.radius, keep, total);
  resizeTail(c.part, keep, total);
  resizeTail(c.shift, keep, total);
  resizeTail(c.measuredWidth, keep, total);
  resizeTail(c.measured, keep, total);
  if (!c.information.empty()) {
    c.information.resize(keep);
    c.information.resize(total);  // nothing is known of the new ones
  }
  for (std::size_t i = 0; i < tail.size(); ++i) {
    c.base[keep + i] = tail[i];
    c.chain[keep + i] = keep + i < chain.size() ? chain[keep + i] : tail[i];
    c.measured[keep + i] = 1;
  }
}

// Profile at a place, averaged over 3 px along the direction.
StrokeCentre centreAt(const StrokeCourse& c, const Vec2& at, const Vec2& direction, const GreyImage& grey) {
  const auto samples = static_cast<std::size_t>(2 * c.profileHalf + 1);
  std::vector<float> mean(samples, 0.0f), scratch(samples);
  const Vec2 normal = leftNormal(direction);
  for (int d = -1; d <= 1; ++d) {
    for (std::size_t k = 0; k < samples; ++k) {
      const double u = (static_cast<int>(k) - c.profileHalf) * kStrokeStepPx;
      const Vec2 p = at + d * direction + u * normal;
      mean[k] += sampleGrey(grey, p.x(), p.y()) / 3.0f;
    }
  }
  return halfLevelCentre(mean, c.widthPx, scratch);
}

// Smoothing a mask eats the ends of thin strokes: follows the ink on the grey values from the end of the skeleton on,
// as long as it stays this stroke (about its width and darkness, no turn).
void followInk(StrokeCourse& c, const GreyImage& grey) {
  const double w = c.widthPx, farthest = 30.0 + 2.0 * w;
  const int back = std::max(4, static_cast<int>(std::lround(w)));
  const int n = static_cast<int>(c.base.size());
  const int hook = std::min(n - back - 2, static_cast<int>(std::ceil(0.5 * w)));
  if (hook < 1) return;
  std::vector<Vec2> path(c.base.end() - hook - back - 1, c.base.end() - hook);
  const auto direction = [&] {
    return Vec2((path.back() - path[path.size() - 1 - static_cast<std::size_t>(back)]).normalized());
  };
  const StrokeCentre here = centreAt(c, path.back(), direction(), grey);
  if (!here.ok) return;
  const std::size_t known = path.size();
  while (static_cast<double>(path.size() - known) < farthest) {
    const Vec2 d = direction(), at = path.back() + d;
    const StrokeCentre next = centreAt(c, at, d, grey);
    const bool same = next.ok && next.contrast > 0.6 * here.contrast && next.width < 1.4 * here.width + 0.5 &&
                      next.width > 0.6 * here.width && std::abs(next.centre) < 0.75;
    if (!same) break;
    path.push_back(at + 0.5 * next.centre * leftNormal(d));
  }
  if (static_cast<double>(path.size() - known) < hook + 1.0) return;
  replaceTail(c, static_cast<std::size_t>(n - hook), {path.begin() + static_cast<std::ptrdiff_t>(known), path.end()});
}

void turnRound(StrokeCourse& c) {
  std::reverse(c.chain.begin(), c.chain.end());
  std::reverse(c.base.begin(), c.base.end());
  std::reverse(c.tangent.begin(), c.tangent.end());
  for (Vec2& t : c.tangent) t = -t;
  std::reverse(c.radius.begin(), c.radius.end());
  std::reverse(c.part.begin(), c.part.end());
  std::reverse(c.shift.begin(), c.shift.end());
  std::reverse(c.measuredWidth.begin(), c.measuredWidth.end());
  std::reverse(c.measured.begin(), c.measured.end());
  std::reverse(c.information.begin(), c.information.end());
  std::swap(c.tip[0], c.tip[1]);
}

// Ends the course half a pen's width before the end of the ink.
void placeLastPoint(StrokeCourse& c, const GreyImage& grey) {
  const int n = static_cast<int>(c.base.size());
  const double w = c.widthPx;
  // From a place about a width inside, where the direction is still that of the stroke.
  const int inside = std::min(n / 2, static_cast<int>(std::lround(w + 3.0)));
  const int anchor = n - 1 - inside;
  const CourseApproach a = approachAt(c, anchor, -1, std::max(8.0, 4.0 * w));
  if (!a.ok) return;
  EndCourse end{a.at, a.direction, a.bend};
  // No turn of more than about 30 degrees is read from a parabola beyond its points.
  const double most = 0.5 / (inside + w);
  if (end.bend.norm() > most) end.bend *= most / end.bend.norm();
  const std::optional<double> tip = inkEnd(end, w, inside, grey);
  if (!tip) return;
  const double stop = std::max(0.0, *tip + 0.06 * w - 0.5 * w);
  // A skeleton ends within a pixel or two of the pen's last place; farther off, the parabola has left the stroke.
  if (std::abs(stop - inside) > 0.6 * w + 2.0) return;
  // The last half width of a skeleton turns to one corner of the pen's end.
  const int kept =
      std::clamp(std::min(static_cast<int>(stop - 0.5), inside - static_cast<int>(std::ceil(0.5 * w))), 0, inside);
  const Vec2 offset = c.base[anchor + kept] - end.position(kept);
  const int count = std::max(0, static_cast<int>(std::lround(stop - kept)));
  std::vector<Vec2> tail;
  for (int k = 1; k <= count; ++k) tail.push_back(end.position(kept + (stop - kept) * k / count) + offset);
  replaceTail(c, static_cast<std::size_t>(anchor + kept + 1), tail);
}

}  // namespace

void placeEnds(StrokeCourse& c, const GreyImage& grey) {
  if (c.closed || c.base.size() < 8) return;
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

namespace {

// Standard deviations of the points. Those that only the half levels of their profile have placed are known half as
// well as those next to them.
void addSigmas(Contour& contour, std::vector<PointInformation> information) {
  const auto known = std::find_if(information.begin(), information.end(),
                                  [](const PointInformation& point) { return point.gain > 0.0; });
  double gain = known == information.end() ? 0.0 : known->gain;
  std::vector<std::uint8_t> placed(contour.points.size());
  for (std::size_t i = 0; i < information.size(); ++i) {
    placed[i] = contour.points[i].refined ? 1 : 0;
    if (information[i].gain > 0.0) {
      gain = information[i].gain;
    } else if (contour.points[i].refined) {
      information[i].gain = 2.0 * gain;
    }
  }
  const std::vector<float> sigma = pointSigmas(information, placed, contour.closed);
  for (std::size_t i = 0; i < sigma.size(); ++i) contour.points[i].sigmaPx = sigma[i];
}

}  // namespace

Contour contourOf(const StrokeCourse& c) {
  Contour contour;
  contour.kind = ContourKind::Centreline;
  contour.closed = c.closed;
  std::vector<StrokePart> part;
  std::vector<PointInformation> information;
  for (std::size_t i = 0; i < c.base.size(); ++i) {
    if (!contour.points.empty()) {
      // Never back: where a tight turn folded the course, its points go.
      const Vec2 step = c.base[i] - contour.points.back().at;
      if (step.norm() < 0.35 || step.dot(c.tangent[i]) < 0.0) continue;
    }
    contour.points.push_back({.at = c.base[i],
                              .unrefined = c.chain[i],
                              .refined = c.measured[i] != 0,
                              .widthPx = std::max(0.1f, c.measuredWidth[i])});
    part.push_back(c.part[i]);
    if (i < c.information.size()) information.push_back(c.information[i]);
  }
  while (contour.closed && contour.points.size() > 3 &&
         (contour.points.front().at - contour.points.back().at).norm() < 0.35) {
    contour.points.pop_back();
    part.pop_back();
    if (!information.empty()) information.pop_back();
  }
  if (!information.empty()) addSigmas(contour, std::move(information));
  const int n = static_cast<int>(part.size());
  for (int i = 0; i < n; ++i) {
    if (part[i] != StrokePart::Bridge) continue;
    int last = i;
    while (last + 1 < n && part[last + 1] == StrokePart::Bridge) ++last;
    contour.bridges.emplace_back(i, last);
    i = last;
  }
  measureContour(contour);
  return contour;
}

}  // namespace batten
