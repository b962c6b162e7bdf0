// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// An arc of a circle or a straight line that passes near the origin of its frame, about along the frame's x axis:
/// y = a + b x + c (x^2 + y^2).
struct LocalArc {
  Eigen::Vector3d abc = Eigen::Vector3d::Zero();  ///< [px, -, 1/px]

  Vec2 gradientAt(const Vec2& p) const { return {abc[1] + 2.0 * abc[2] * p.x(), 2.0 * abc[2] * p.y() - 1.0}; }
  Vec2 normalAt(const Vec2& p) const { return gradientAt(p).normalized(); }
  /// From p to the nearest point of the arc, to first order.
  Vec2 toArc(const Vec2& p) const;
};

/// Points of the page in a frame at `origin` with its x axis `along` (a unit vector).
struct LocalFrame {
  Vec2 origin = Vec2::Zero(), along = Vec2::UnitX();
  Vec2 local(const Vec2& p) const;
  /// A direction or distance of the frame, on the page.
  Vec2 page(const Vec2& d) const;
};

/// The arc that lies nearest to both stretches of points, which count alike, by least squares of the equation above;
/// nothing where that has no finite solution. Both stretches have points; whether the arc lies near them squaresLeft()
/// says.
std::optional<LocalArc> arcThrough(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

/// [px] What a skeleton leaves of the true course of a stroke beyond its forks: its pixels, and a part of the width. On
/// drawings and pages of lines that share ink it is .3 to .8 px, of those that do not 1.4 and more, at 5 px.
inline double mostLeftPx(double widthPx) {
  constexpr double kMissPx = 0.5, kMissWidths = 0.08;  // by its pixels, by the width
  return kMissPx + kMissWidths * widthPx;
}

/// [px^2] Mean of the squared distances of the points.
double squaresLeft(const LocalArc& arc, const std::vector<Vec2>& points);

}  // namespace batten
