// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/typical/typical_line.h"
#include "core/construct/typical/typical_path_fit.h"

namespace batten {

/// What happened while a chain grew (002 figures 3 and 5). Model frame, mm; px while it grows.
struct GrowingStep {
  enum class Kind {
    Seed,          ///< A first small curve fitted to the points, or what was left of the fit before.
    Extrapolated,  ///< The curve run on, exactly.
    Fitted,        ///< Bent until it meets the points again; start, direction, curvature and size stay.
    Kept,          ///< The growing stopped: what stays of the last good fit.
  };
  Kind kind = Kind::Seed;
  int segment = 0;  ///< Number of the segment, from 0.
  TypicalCurve curve;
  double deviationRad = 0.0;  ///< Between the normals of the curve's end and of the points there.
  double distance = 0.0;      ///< [mm] Largest mean distance of neighbouring points.
  bool stops = false;         ///< Fitted: this fit is not good enough any more.
};
std::string_view name(GrowingStep::Kind);

/// Whether the steps are written down, which takes a look at the points for each.
enum class StepRecord { None, Kept };

/// The growing process of 002 section 6 for one piece in mm, with every step. Empty for lines that nowhere bend
/// clearly.
/// @param pixelMm [mm] > 0, size of a pixel.
Result<std::vector<GrowingStep>> growingSteps(const ConstructPiece&, double pixelMm, const ConstructParams&,
                                              const RunContext&);

struct GrownPath {
  std::optional<FoundPath> found;  ///< Absent where nothing grows or it was cancelled.
  std::vector<GrowingStep> steps;  ///< Where they are asked for, also without a path.
};
/// The grown path. Stable: only the first half of each fit stays, as the start of the next segment is only known as
/// well as the fit before; `growingAsInPaper` keeps all.
GrownPath grownPath(const TypicalLine&, std::span<const Vec2> breakpoints, const ConstructParams&, StepRecord,
                    const RunContext&);

}  // namespace batten
