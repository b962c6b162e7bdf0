// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/construct/typical/typical_growing.h"

namespace batten {

/// The stretch of a line that one growing chain covers.
struct GrowingStretch {
  std::size_t firstJoint = 0, lastJoint = 0;  ///< Indices into TypicalLine::joints.
  std::vector<Vec2> points;                   ///< [px] Those of the line between the two.
  bool isOne = false;                         ///< Between two places of the user: one segment, however well it fits.
};

/// Where a stretch of growing curves starts.
struct GrowingStart {
  PathState state;
  bool isFree = false;  ///< Nothing comes before: direction and curvature are found too.
  int segment = 0;      ///< Number of the first segment.
};
/// Typical curves that have grown, and the state in which the last one ends.
struct GrownCurves {
  std::vector<TypicalCurve> curves;
  PathState end;
  int segment = 0;                 ///< Number of the last segment that was begun.
  bool rested = true;              ///< Every fit whose curve was kept came to rest.
  std::vector<GrowingStep> steps;  ///< Where they are asked for.
};
/// Grows typical curves over a stretch, one after the other, each as far as it fits.
GrownCurves growStretch(const TypicalLine& line, const ConstructParams& params, const GrowingStretch& stretch,
                        const GrowingStart& start, StepRecord, const RunContext& context);

}  // namespace batten
