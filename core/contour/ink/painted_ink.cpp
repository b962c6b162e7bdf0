// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/painted_ink.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/image/bits/run_pieces.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

struct Interval {
  double from = 0.0, to = 0.0;
};

/// Where a * x + b lies between two values; all x where it does not change. Empty: never.
std::optional<Interval> where(double a, double b, double low, double high, Interval all) {
  if (a == 0.0) return b >= low && b <= high ? std::optional(all) : std::nullopt;
  double from = (low - b) / a, to = (high - b) / a;
  if (from > to) std::swap(from, to);
  all.from = std::max(all.from, from);
  all.to = std::min(all.to, to);
  return all.from <= all.to ? std::optional(all) : std::nullopt;
}

/// What of a row at height y lies within `radius` of the straight line from a to b: one interval, as both ends' discs
/// and the strip between them make a convex area.
std::optional<Interval> acrossCapsule(const Vec2& a, const Vec2& b, double radius, double y, double width) {
  std::optional<Interval> found;
  const auto add = [&found](double from, double to) {
    if (!found) found = Interval{from, to};
    found = Interval{std::min(found->from, from), std::max(found->to, to)};
  };
  for (const Vec2& end : {a, b}) {
    const double dy = y - end.y(), rest = radius * radius - dy * dy;
    if (rest >= 0.0) add(end.x() - std::sqrt(rest), end.x() + std::sqrt(rest));
  }
  const double length = (b - a).norm();
  if (!(length > 0.0)) return found;
  const Vec2 along = (b - a) / length;
  // Places (x, y): how far along the line, and how far beside it.
  const double dy = y - a.y();
  auto strip = where(along.x(), along.y() * dy - along.x() * a.x(), 0.0, length, {0.0, width});
  if (strip) strip = where(-along.y(), along.x() * dy + along.y() * a.x(), -radius, radius, *strip);
  if (strip) add(strip->from, strip->to);
  return found;
}

/// Rows of a picture, from the first to the one behind the last.
struct Rows {
  int begin = 0, end = 0;
};

Rows fillAround(const PaintedInk& painted, BitImage& brush, const RunContext& context) {
  Rows touched{brush.height, 0};
  const auto& course = painted.coursePx;
  for (std::size_t i = 0; i < course.size() && !context.isCancelled(); ++i) {
    const Vec2 &a = course[i], &b = course[std::min(i + 1, course.size() - 1)];
    const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, static_cast<double>(brush.height))); };
    const int y0 = row(std::floor(std::min(a.y(), b.y()) - painted.radiusPx));
    const int y1 = row(std::ceil(std::max(a.y(), b.y()) + painted.radiusPx) + 1.0);
    for (int y = y0; y < y1; ++y) {
      const auto across = acrossCapsule(a, b, painted.radiusPx, y + 0.5, brush.width);
      if (!across) continue;
      // Pixels whose centres lie within.
      const auto column = [&](double x) {
        return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(brush.width)));
      };
      const int x0 = column(std::ceil(across->from - 0.5)), x1 = column(std::floor(across->to - 0.5) + 1.0);
      if (x0 < x1) setBits(brush, {y, x0, x1});
    }
    touched = {std::min(touched.begin, y0), std::max(touched.end, y1)};
  }
  return touched;
}

}  // namespace

bool isUnder(const PaintedInk& painted, const Vec2& px) {
  const auto& course = painted.coursePx;
  for (std::size_t i = 0; i < course.size(); ++i) {
    const Vec2& end = course[std::min(i + 1, course.size() - 1)];
    if (awayFromSegment(px, course[i], end).norm() <= painted.radiusPx) return true;
  }
  return false;
}

BitImage applyPaint(std::span<const PaintedInk> painted, BitImage& strokes, BitImage& shapes,
                    const RunContext& context) {
  const BitImage ownShapes = shapes;
  BitImage all(strokes.width, strokes.height), brush = all;
  for (const PaintedInk& one : painted) {
    if (context.isCancelled()) break;
    const Rows rows = fillAround(one, brush, context);
    for (int y = rows.begin; y < rows.end; ++y) {
      for (int i = 0; i < brush.wordsPerRow; ++i) {
        std::uint64_t &stroke = strokes.row(y)[i], &shape = shapes.row(y)[i], &under = brush.row(y)[i];
        const std::uint64_t ink = under & (stroke | shape), rest = (stroke | shape) & ~under;
        std::uint64_t toShape = one.mode == EdgeMode::Outline ? ink : 0;
        if (one.mode == EdgeMode::Automatic) toShape = ink & ownShapes.row(y)[i];
        shape = (shape & rest) | toShape;
        stroke = (stroke & rest) | (ink & ~toShape);
        all.row(y)[i] = one.mode == EdgeMode::Automatic ? all.row(y)[i] & ~under : all.row(y)[i] | ink;
        under = 0;
      }
    }
  }
  return all;
}

}  // namespace batten
