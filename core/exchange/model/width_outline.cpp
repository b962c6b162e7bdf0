// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/width_outline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "core/exchange/model/border_fit.h"
#include "core/exchange/model/stroke_middle.h"

namespace batten {
namespace {

constexpr double kCornerRad = 1e-3;       ///< Smaller turns from piece to piece are rounding.
constexpr double kArcStepRad = 0.1;       ///< Between the places of a round end.
constexpr double kLoopReachWidths = 6.0;  ///< Along the stroke: so far from a tight turn its borders may cross.

Vec2 rotated(const Vec2& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

BorderPlace borderPlace(const StrokeMiddle& stroke, std::ptrdiff_t i, double side) {
  const MiddlePlace& middle = stroke.places[i];
  const Vec2 normal = side * leftNormal(middle.along);
  const double half = 0.5 * middle.width;
  BorderPlace place{.at = middle.at + half * normal, .begins = middle.begins, .middle = i};
  const Vec2 along = (1.0 - side * middle.kappa * half) * middle.along + 0.5 * middle.growth * normal;
  place.isBackwards = along.dot(middle.along) <= 0.0;
  place.along = place.isBackwards ? middle.along : along.normalized();
  return place;
}

/// An arc about a place of the middle from `out`, its radius going from one value to another.
struct BorderArc {
  Vec2 centre, out;
  double angle, fromRadius, toRadius;
  std::ptrdiff_t middle;
};

std::vector<BorderPlace> arcPlaces(const BorderArc& arc) {
  std::vector<BorderPlace> border;
  const int steps = std::max(4, static_cast<int>(std::ceil(std::abs(arc.angle) / kArcStepRad)));
  const double turn = std::abs(arc.angle);
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Vec2 radius = rotated(arc.out, t * arc.angle);
    const double length = std::lerp(arc.fromRadius, arc.toRadius, t), growth = (arc.toRadius - arc.fromRadius) / turn;
    border.push_back(
        {.at = arc.centre + length * radius,
         .along = (length * (arc.angle > 0.0 ? 1.0 : -1.0) * leftNormal(radius) + growth * radius).normalized(),
         .begins = i == 0,
         .middle = arc.middle});
  }
  return border;
}

void appendPlaces(const std::vector<BorderPlace>& places, std::vector<BorderPlace>& border) {
  border.insert(border.end(), places.begin(), places.end());
}

/// One side of a stroke, in its direction of travel: +1 the left one.
std::vector<BorderPlace> sideOf(const StrokeMiddle& middle, double side) {
  std::vector<BorderPlace> border;
  const auto& places = middle.places;
  for (std::ptrdiff_t i = 0; i < std::ssize(places); ++i) {
    if (places[i].begins && i > 0) {
      const Vec2 &before = places[i - 1].along, &behind = places[i].along;
      const double turn = std::atan2(cross(before, behind), before.dot(behind));
      if (std::abs(turn) > kCornerRad && turn * side < 0.0) {
        appendPlaces(arcPlaces({places[i].at, side * leftNormal(before), turn, 0.5 * places[i - 1].width,
                                0.5 * places[i].width, i}),
                     border);
      } else if (std::abs(turn) > kCornerRad && !border.empty()) {
        border.back().isBackwards = true;  // an inner corner: the borders of its sides cross
      }
    }
    border.push_back(borderPlace(middle, i, side));
  }
  return border;
}

std::optional<Vec2> crossingOf(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 ab = b - a, cd = d - c, ac = c - a;
  const double area = cross(ab, cd);
  if (area == 0.0) return std::nullopt;
  const double t = cross(ac, cd) / area, r = cross(ac, ab) / area;
  if (!(t >= 0.0 && t <= 1.0 && r >= 0.0 && r <= 1.0)) return std::nullopt;
  return a + t * ab;
}

/// Takes the loops out of a side that a turn tighter than half the width leaves on its inside.
class LoopRemoval {
 public:
  LoopRemoval(const std::vector<BorderPlace>& border, const StrokeMiddle& middle, double reach)
      : border_(border), middle_(middle), reach_(reach), exposed_(border.size()) {}

  std::vector<BorderPlace> done() {
    const std::ptrdiff_t n = std::ssize(border_);
    for (std::ptrdiff_t next = 0; next < n;) {
      if (!border_[next].isBackwards) {
        keep(border_[next], next);
        ++next;
        continue;
      }
      std::ptrdiff_t to = next;
      while (to + 1 < n && border_[to + 1].isBackwards) ++to;
      if (const auto crossing = crossingAround(next, std::min(to + 1, n - 1))) {
        cutAt(*crossing);
        next = crossing->last + 1;
      } else {
        next = bridge(next, to);
      }
    }
    std::vector<BorderPlace> places;
    for (const Kept& one : kept_) places.push_back(one.place);
    return places;
  }

 private:
  static constexpr double kCoveredShare = 0.01;  ///< Of the width: so deep in the ink a place is no border.
  static constexpr double kNearShare = 0.15;     ///< Of the width: so near to a crossing a loop is not deep yet.

  struct Crossing {
    std::ptrdiff_t first = 0, last = 0;  ///< Places before the two stretches that cross.
    Vec2 at = Vec2::Zero();
  };
  struct Kept {
    BorderPlace place;
    std::ptrdiff_t index;
  };

  void keep(const BorderPlace& place, std::ptrdiff_t index) { kept_.push_back({place, index}); }

  void cutAt(const Crossing& crossing) {
    while (!kept_.empty() && kept_.back().index > crossing.first) kept_.pop_back();
    if (kept_.empty() || kept_.back().index < crossing.first) keep(border_[crossing.first], crossing.first);
    const Vec2 in = crossing.at - kept_.back().place.at, out = border_[crossing.last + 1].at - crossing.at;
    const std::ptrdiff_t middle = border_[crossing.last].middle;
    if (in.norm() > 0.0) keep({.at = crossing.at, .along = in.normalized(), .middle = middle}, crossing.last);
    if (out.norm() > 0.0)
      keep({.at = crossing.at, .along = out.normalized(), .begins = true, .middle = middle}, crossing.last);
  }

  /// A loop too small to show a crossing, or one near an end: straight on from the last place before it from which the
  /// border goes forwards to one behind it. @return the next place.
  std::ptrdiff_t bridge(std::ptrdiff_t from, std::ptrdiff_t to) {
    std::ptrdiff_t before = from - 1, behind = to + 1;
    const std::ptrdiff_t n = std::ssize(border_);
    const auto isForwards = [&] {
      const Vec2 step = border_[behind].at - border_[before].at;
      return step.dot(border_[before].along) > 0.0 && step.dot(border_[behind].along) > 0.0;
    };
    for (double gone = 0.0; before > 0 && behind + 1 < n && gone < reach_ && !isForwards(); --before, ++behind)
      gone += (border_[behind + 1].at - border_[behind].at).norm();
    while (!kept_.empty() && kept_.back().index > before) kept_.pop_back();
    if (behind >= n) return n;
    keep(border_[behind], behind);
    kept_.back().place.begins = true;
    return behind + 1;
  }

  /// Whether a place of the side is border of the stroke, not in its ink.
  bool isExposed(std::ptrdiff_t i) {
    if (exposed_[i]) return *exposed_[i];
    bool isInk = false;
    const auto& places = middle_.places;
    for (const std::ptrdiff_t step : {-1, 1}) {
      double gone = 0.0;
      for (std::ptrdiff_t m = border_[i].middle; m >= 0 && m < std::ssize(places) && gone < reach_ && !isInk;
           m += step) {
        const double half = (0.5 - kCoveredShare) * places[m].width;
        isInk = (places[m].at - border_[i].at).squaredNorm() < half * half;
        if (m + step >= 0 && m + step < std::ssize(places)) gone += (places[m + step].at - places[m].at).norm();
      }
    }
    exposed_[i] = !isInk;
    return !isInk;
  }

  /// Nothing of the border is lost with the loop behind a crossing.
  bool isLoopOnly(const Crossing& crossing) {
    for (std::ptrdiff_t i = crossing.first + 1; i <= crossing.last; ++i) {
      const double near = kNearShare * middle_.places[border_[i].middle].width;
      if ((border_[i].at - crossing.at).norm() > near && isExposed(i)) return false;
    }
    return true;
  }

  /// The outermost crossing around a stretch that runs backwards with nothing but ink in its loop.
  std::optional<Crossing> crossingAround(std::ptrdiff_t from, std::ptrdiff_t to) {
    std::ptrdiff_t first = from, last = to;
    const auto step = [&](std::ptrdiff_t i) { return (border_[i + 1].at - border_[i].at).norm(); };
    for (double gone = 0.0; first > 0 && gone < reach_; gone += step(first)) --first;
    for (double gone = 0.0; last + 2 < std::ssize(border_) && gone < reach_; gone += step(last)) ++last;
    last = std::min(last, std::ssize(border_) - 2);
    for (std::ptrdiff_t i = first; i <= from && i + 1 < std::ssize(border_); ++i) {
      for (std::ptrdiff_t k = last; k >= std::max(i + 2, to - 1); --k) {
        const auto at = crossingOf(border_[i].at, border_[i + 1].at, border_[k].at, border_[k + 1].at);
        if (at && isLoopOnly({i, k, *at})) return Crossing{i, k, *at};
      }
    }
    return std::nullopt;
  }

  const std::vector<BorderPlace>& border_;
  const StrokeMiddle& middle_;
  double reach_;
  std::vector<std::optional<bool>> exposed_;
  std::vector<Kept> kept_;
};

std::vector<BorderPlace> reversedBorder(std::vector<BorderPlace> border) {
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
  const auto sideWithoutLoops = [&](double side) {
    const std::vector<BorderPlace> border = sideOf(middle, side);
    return LoopRemoval(border, middle, reach).done();
  };
  const auto left = sideWithoutLoops(1.0), right = sideWithoutLoops(-1.0);
  if (middle.closed) {
    addLoop(right, tolerance, check, outline);
    addLoop(reversedBorder(left), tolerance, check, outline);
    return;
  }
  // Anticlockwise: the right side, round the end, the left side back, round the start.
  std::vector<BorderPlace> border = right;
  const auto addCap = [&](const MiddlePlace& end, const Vec2& from) {
    if (end.width > 0.0)
      appendPlaces(arcPlaces({end.at, from, std::numbers::pi, 0.5 * end.width, 0.5 * end.width, 0}), border);
  };
  addCap(middle.places.back(), -leftNormal(middle.places.back().along));
  const auto back = reversedBorder(left);
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

}  // namespace batten
