// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/construct/typical/typical_growing.h"

namespace batten {

/// The stretch of a line that one growing chain covers.
struct GrowingStretch {
  std::size_t firstJoint = 0, lastJoint = 0;
  std::vector<Vec2> points;
};

/// What is written down while chains grow.
struct GrowingRecord {
  std::vector<GrowingStep>* steps = nullptr;  ///< Null: nothing.
  int segment = 0;                            ///< Number of the next segment.
  bool rested = true;                         ///< Every fit whose curve was kept came to rest.
};

/// Grows typical curves from a state over a stretch; the state becomes where they end. @param freeStart nothing comes
/// before: direction and curvature at the start are found too.
std::vector<TypicalCurve> growStretch(const TypicalLine& line, const ConstructParams& params,
                                      const GrowingStretch& stretch, bool freeStart, PathState& from,
                                      GrowingRecord& record, const RunContext& context);

}  // namespace batten
