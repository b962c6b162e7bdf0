// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_path_feet.h"

#include <algorithm>
#include <cmath>

#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_geometry.h"
#include "core/curve/foot_step.h"

namespace batten {

namespace {

// Parameters of an element run from 0 to 1.
constexpr int kPathFeetSteps = 25;
constexpr int kLastChange = 20;       ///< Later steps stay in their element: a foot at a joint may go to and fro.
constexpr double kLongestStep = 0.7;  ///< Less than an element, so that none is passed over.
constexpr double kBeyondEnds = 0.4;   ///< A path may end this far before the last points, and grows towards them.
constexpr double kSettled = 1e-9;     // [parameter]

/// Newton on the distance, from where the foot is; passes from element to element.
PathFoot refined(const std::vector<PathGeometry>& geometry, const Vec2& p, PathFoot foot) {
  for (int i = 0; i < kPathFeetSteps; ++i) {
    const auto d = geometry[foot.element].at(foot.t, 2);
    const Vec2 away = d[0] - p;
    const double speed = d[1].squaredNorm();
    foot.distance = speed > 0.0 ? cross(d[1], p - d[0]) / std::sqrt(speed) : away.norm();
    if (!(speed > 0.0)) break;
    const double next = foot.t + std::clamp(footStep(away, d[1], d[2]), -kLongestStep, kLongestStep);
    const bool forward = next > 1.0 && foot.element + 1 < geometry.size(), back = next < 0.0 && foot.element > 0;
    if ((forward || back) && i < kLastChange) {
      forward ? ++foot.element : --foot.element;
      foot.t = forward ? 0.0 : 1.0;
      continue;
    }
    const double t = std::clamp(next, foot.element > 0 ? 0.0 : -kBeyondEnds,
                                foot.element + 1 < geometry.size() ? 1.0 : 1.0 + kBeyondEnds);
    const bool done = std::abs(t - foot.t) < kSettled;
    foot.t = t;
    if (done) break;
  }
  return foot;
}

/// From the foot of the point before. In sharp turns more elements may lie between two points than steps lead across.
PathFoot nextFoot(const std::vector<PathGeometry>& geometry, const Vec2& p, const PathFoot& before) {
  const PathFoot foot = refined(geometry, p, before);
  const auto away = [&](const PathFoot& f) { return (geometry[f.element].at(f.t, 0)[0] - p).squaredNorm(); };
  PathFoot ahead = before;
  while (ahead.element + 1 < geometry.size() && away({ahead.element + 1}) <= away({ahead.element})) ++ahead.element;
  if (ahead.element <= before.element + kLastChange) return foot;
  ahead = refined(geometry, p, {ahead.element});
  return away(ahead) < away(foot) ? ahead : foot;
}

}  // namespace

void followFeet(const std::vector<PathGeometry>& geometry, const std::vector<Vec2>& points,
                std::vector<PathFoot>& feet) {
  const bool fresh = feet.size() != points.size();
  if (fresh) feet.assign(points.size(), {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    feet[i] = fresh && i > 0 ? nextFoot(geometry, points[i], feet[i - 1]) : refined(geometry, points[i], feet[i]);
  }
}

}  // namespace batten
