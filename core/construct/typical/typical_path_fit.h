// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_feet.h"

namespace batten {

/// What a fit is to meet.
struct PathData {
  std::vector<Vec2> points;                       ///< In order along the path.
  Vec2 start = Vec2::Zero(), end = Vec2::Zero();  ///< Open: where the path is pinned.
  /// A state with a place of its own along the line (set by the user), by index; the path may pass it sideways.
  std::vector<std::optional<Vec2>> places;
  double noise = 0.3;     ///< Standard deviation of a point.
  double outlier = 0.0;   ///< Distance from which on a point counts less; 0 = never.
  double fairness = 3.0;  ///< Weight of differences of log h of neighbours, per standard deviation.
  /// Free states keep place, direction and curvature: about this far [units] may a piece move by each; 0 = they are
  /// free, and the curvature of Hermite pieces is evened out instead.
  double hold = 0.0;
};

struct PathFit {
  double cost = 0.0;   ///< Sum of squared distances, outliers damped.
  double rms = 0.0;    ///< Of the distances.
  double noise = 0.0;  ///< Standard deviation of a point that was reckoned with in the end.
  int unknowns = 0;
  int iterations = 0;
  bool converged = false;
  std::vector<PathFoot> feet;  ///< One per point.
};

/// A path, and whether the fit that gave it, or every one of its fits, came to rest.
struct FoundPath {
  TypicalPath path;
  bool converged = true;
};

/// A path and how it fits.
struct FittedPath {
  TypicalPath path;
  PathFit fit;
};

/// Levenberg-Marquardt with analytic derivatives from a path on; closes or pins it exactly at the end. The best found,
/// also when cancelled. A path of Hermite pieces alone that is held to its line stays as it is. Absent where the path
/// or its start is impossible.
std::optional<FittedPath> fitPath(TypicalPath path, const PathData& data, int maxIterations,
                                  const RunContext& context = {});

}  // namespace batten
