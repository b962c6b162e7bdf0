// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/width_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/exchange/model/border_fit.h"
#include "core/exchange/model/stroke_middle.h"

namespace batten {
namespace {

constexpr double kCornerRad = 1e-3;       ///< Smaller turns from piece to piece are rounding.
constexpr double kArcStepRad = 0.1;       ///< Between the places of a round end.
constexpr double kLoopReachWidths = 6.0;  ///< Along the stroke: so far from a tight turn its borders may cross.

Vec2 turnedBy(const Vec2& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

BorderPlace borderPlace(const MiddlePlace& middle, double side, bool begins) {
  const Vec2 normal = side * leftNormal(middle.along);
  const double half = 0.5 * middle.width;
  BorderPlace place{middle.at + half * normal,
                    (1.0 - side * middle.kappa * half) * middle.along + 0.5 * middle.growth * normal, begins, false};
  place.isBackwards = place.along.dot(middle.along) <= 0.0;
  place.along = place.isBackwards || !(place.along.norm() > 0.0) ? middle.along : place.along.normalized();
  return place;
}

/// An arc about a place of the middle, from one direction on by an angle.
void addArc(const Vec2& centre, const Vec2& out, double angle, double fromRadius, double toRadius,
            std::vector<BorderPlace>& border) {
  const int steps = std::max(4, static_cast<int>(std::ceil(std::abs(angle) / kArcStepRad)));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Vec2 radius = turnedBy(out, t * angle);
    border.push_back({centre + std::lerp(fromRadius, toRadius, t) * radius,
                      (angle > 0.0 ? 1.0 : -1.0) * leftNormal(radius), i == 0, false});
  }
}

/// One side of a stroke, in its direction of travel: +1 the left one.
std::vector<BorderPlace> sideOf(const StrokeMiddle& middle, double side) {
  std::vector<BorderPlace> border;
  const auto& places = middle.places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].begins && i > 0) {
      const Vec2 &before = places[i - 1].along, &behind = places[i].along;
      const double turn = std::atan2(cross(before, behind), before.dot(behind));
      if (std::abs(turn) > kCornerRad && turn * side < 0.0) {
        addArc(places[i].at, side * leftNormal(before), turn, 0.5 * places[i - 1].width, 0.5 * places[i].width, border);
      } else if (std::abs(turn) > kCornerRad && !border.empty()) {
        border.back().isBackwards = true;  // an inner corner: the borders of its sides cross
      }
    }
    border.push_back(borderPlace(places[i], side, places[i].begins));
  }
  return border;
}

struct Crossing {
  std::size_t first = 0, last = 0;  ///< Places before the two stretches that cross.
  Vec2 at = Vec2::Zero();
};

std::optional<Vec2> crossingOf(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 ab = b - a, cd = d - c, ac = c - a;
  const double area = cross(ab, cd);
  if (area == 0.0) return std::nullopt;
  const double t = cross(ac, cd) / area, r = cross(ac, ab) / area;
  if (!(t >= 0.0 && t <= 1.0 && r >= 0.0 && r <= 1.0)) return std::nullopt;
  return a + t * ab;
}

/// The outermost crossing of a border around a stretch that runs backwards.
std::optional<Crossing> crossingAround(const std::vector<BorderPlace>& border, std::size_t from, std::size_t to,
                                       double reach) {
  std::size_t first = from, last = to;
  for (double gone = 0.0; first > 0 && gone < reach; --first) gone += (border[first].at - border[first - 1].at).norm();
  for (double gone = 0.0; last + 2 < border.size() && gone < reach; ++last)
    gone += (border[last + 1].at - border[last].at).norm();
  for (std::size_t i = first; i <= from && i + 1 < border.size(); ++i) {
    for (std::size_t k = std::min(last, border.size() - 2); k > std::max(i + 1, to > 0 ? to - 1 : 0); --k) {
      const auto at = crossingOf(border[i].at, border[i + 1].at, border[k].at, border[k + 1].at);
      if (at) return Crossing{i, k, *at};
    }
  }
  return std::nullopt;
}

/// The border without the loops that a turn tighter than half the width leaves on its inside.
std::vector<BorderPlace> withoutLoops(const std::vector<BorderPlace>& border, double reach) {
  std::vector<BorderPlace> kept;
  std::size_t next = 0;
  while (next < border.size()) {
    if (!border[next].isBackwards) {
      kept.push_back(border[next++]);
      continue;
    }
    std::size_t to = next;
    while (to + 1 < border.size() && border[to + 1].isBackwards) ++to;
    const auto crossing = crossingAround(border, next, std::min(to + 1, border.size() - 1), reach);
    if (!crossing) {  // near an end: what runs backwards goes
      kept.push_back(border[next]);
      kept.back().begins = true;
      next = to + 1;
      if (next < border.size()) {
        kept.push_back(border[next++]);
        kept.back().begins = true;
      }
      continue;
    }
    if (crossing->first == next)
      kept.push_back(border[next]);
    else
      kept.resize(std::max<std::ptrdiff_t>(1, std::ssize(kept) - std::ptrdiff_t(next - crossing->first - 1)));
    const Vec2 in = (crossing->at - kept.back().at), out = border[crossing->last + 1].at - crossing->at;
    if (in.norm() > 0.0) kept.push_back({crossing->at, in.normalized(), false, false});
    if (out.norm() > 0.0) kept.push_back({crossing->at, out.normalized(), true, false});
    next = crossing->last + 1;
  }
  return kept;
}

std::vector<BorderPlace> turnedRound(std::vector<BorderPlace> border) {
  std::reverse(border.begin(), border.end());
  for (BorderPlace& place : border) place.along = -place.along;
  // What began behind a place now begins at the one after it.
  for (std::size_t i = border.size(); i-- > 1;) border[i].begins = border[i - 1].begins;
  if (!border.empty()) border.front().begins = true;
  return border;
}

double largestWidth(const StrokeMiddle& middle) {
  double most = 0.0;
  for (const MiddlePlace& place : middle.places) most = std::max(most, place.width);
  return most;
}

/// A ring begins where it is straightest: there its borders have no loop.
void beginStraight(StrokeMiddle& ring) {
  auto& places = ring.places;
  std::ptrdiff_t straightest = 1;
  for (std::ptrdiff_t i = 1; i + 1 < std::ssize(places); ++i) {
    const auto bend = [&](std::ptrdiff_t k) { return std::abs(places[k].kappa) * places[k].width; };
    if (!places[i].begins && !places[i + 1].begins && bend(i) < bend(straightest)) straightest = i;
  }
  const auto found = places.begin() + straightest;
  MiddlePlace end = *found;
  end.begins = false;
  places.front().begins = true;
  found->begins = true;
  std::rotate(places.begin(), found, places.end());
  places.push_back(end);
}

void addLoop(const std::vector<BorderPlace>& border, double tolerance, CancelCheck check, WidthOutline& outline) {
  CubicRun loop = fittedBorder(border, tolerance, check);
  if (loop.cubics.empty()) return;
  loop.cubics.back()[2] = loop.start;
  outline.cubics += static_cast<int>(loop.cubics.size());
  outline.loops.push_back(std::move(loop));
}

void addOutline(StrokeMiddle middle, double tolerance, CancelCheck check, WidthOutline& outline) {
  const double reach = kLoopReachWidths * largestWidth(middle);
  if (middle.closed) beginStraight(middle);
  const auto left = withoutLoops(sideOf(middle, 1.0), reach), right = withoutLoops(sideOf(middle, -1.0), reach);
  if (middle.closed) {
    addLoop(right, tolerance, check, outline);
    addLoop(turnedRound(left), tolerance, check, outline);
    return;
  }
  // Anticlockwise: the right side, round the end, the left side back, round the start.
  std::vector<BorderPlace> border = right;
  const auto addCap = [&](const MiddlePlace& end, const Vec2& from) {
    if (end.width > 0.0) addArc(end.at, from, std::numbers::pi, 0.5 * end.width, 0.5 * end.width, border);
  };
  addCap(middle.places.back(), -leftNormal(middle.places.back().along));
  const auto back = turnedRound(left);
  border.insert(border.end(), back.begin(), back.end());
  addCap(middle.places.front(), leftNormal(middle.places.front().along));
  addLoop(border, tolerance, check, outline);
}

}  // namespace

WidthOutline widthOutline(const ExportCurve& line, double tolerance, CancelCheck check) {
  WidthOutline outline;
  for (StrokeMiddle& middle : strokeMiddles(line, check)) addOutline(std::move(middle), tolerance, check, outline);
  return outline;
}

namespace {

/// Follows a border along the middle of its stroke.
class MiddleWalk {
 public:
  explicit MiddleWalk(const std::vector<StrokeMiddle>& middles) : middles_(middles) {}

  /// How far a place is from the border of the stroke: 0 on it.
  double off(const Vec2& p) {
    double least = std::numeric_limits<double>::infinity();
    if (isBegun_) least = nearPlace(p);
    // A larger distance than any before is not taken on trust: the border may have left its stretch.
    if (!(least <= largest_)) least = std::min(least, anywhere(p));
    largest_ = std::max(largest_, least);
    isBegun_ = true;
    return least;
  }

 private:
  static constexpr std::ptrdiff_t kNear = 64;  ///< [places] to either side of the last one

  double offAt(const std::vector<MiddlePlace>& places, std::ptrdiff_t i, const Vec2& p, double& nearest) const {
    const MiddlePlace &a = places[i], &b = places[i + 1];
    const Vec2 chord = b.at - a.at;
    const double length = chord.norm();
    if (!(length > 0.0)) return std::numeric_limits<double>::infinity();
    // The arc between two places, by its curvature: the chord alone is off by a hundredth of the width.
    double t = std::clamp((p - a.at).dot(chord) / (length * length), 0.0, 1.0);
    Vec2 foot = Vec2::Zero();
    for (int round = 0; round < 4; ++round) {
      const double r = 1.0 - t;
      foot = r * r * (1.0 + 2.0 * t) * a.at + t * t * (1.0 + 2.0 * r) * b.at +
             length * t * r * (r * a.along - t * b.along);
      const Vec2 along = (r * a.along + t * b.along).normalized();
      const double kappa = std::lerp(a.kappa, b.kappa, t);
      const double bend = std::max(0.2, 1.0 - kappa * (p - foot).dot(leftNormal(along)));
      t = std::clamp(t + (p - foot).dot(along) / (length * bend), 0.0, 1.0);
    }
    const double distance = (p - foot).norm();
    if (distance > nearest) return std::numeric_limits<double>::infinity();
    nearest = distance;
    return std::abs(distance - 0.5 * std::lerp(a.width, b.width, t));
  }
  double over(std::size_t middle, std::ptrdiff_t from, std::ptrdiff_t to, const Vec2& p, double& nearest) {
    const auto& places = middles_[middle].places;
    double off = std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, from); i < std::min(to, std::ssize(places) - 1); ++i) {
      // Far ones cannot be nearest.
      const double step = (places[i + 1].at - places[i].at).norm();
      if ((places[i].at - p).norm() - 2.0 * step > nearest) continue;
      const double one = offAt(places, i, p, nearest);
      if (!std::isfinite(one)) continue;
      off = one;
      middle_ = middle;
      at_ = i;
    }
    return off;
  }
  double nearPlace(const Vec2& p) {
    double nearest = std::numeric_limits<double>::infinity();
    return over(middle_, at_ - kNear, at_ + kNear, p, nearest);
  }
  double anywhere(const Vec2& p) {
    double nearest = std::numeric_limits<double>::infinity(), off = nearest;
    for (std::size_t m = 0; m < middles_.size(); ++m) {
      const double one = over(m, 0, std::ssize(middles_[m].places), p, nearest);
      if (std::isfinite(one)) off = one;
    }
    return off;
  }

  const std::vector<StrokeMiddle>& middles_;
  std::size_t middle_ = 0;
  std::ptrdiff_t at_ = 0;
  bool isBegun_ = false;
  double largest_ = 0.0;
};

}  // namespace

double distanceFromWidth(const std::vector<std::array<Vec2, 4>>& border, const ExportCurve& line, CancelCheck check) {
  const std::vector<StrokeMiddle> middles = strokeMiddles(line, check);
  if (middles.empty() || border.empty()) return std::numeric_limits<double>::infinity();
  constexpr int kPlacesPerCubic = 4;
  MiddleWalk walk(middles);
  double worst = 0.0;
  for (const auto& c : border) {
    if (check.isCancelled()) break;
    for (int k = 0; k < kPlacesPerCubic; ++k) {
      const double t = static_cast<double>(k) / kPlacesPerCubic, r = 1.0 - t;
      worst =
          std::max(worst, walk.off(r * r * r * c[0] + 3 * r * r * t * c[1] + 3 * r * t * t * c[2] + t * t * t * c[3]));
    }
  }
  return worst;
}

}  // namespace batten
