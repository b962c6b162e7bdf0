// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/termination.h"
#include "core/curve/bezier_quintics.h"

namespace batten {

/// Curvature wanted at a share 0..1 of the perimeter [1/unit]: drawn on the plot, or a polynomial.
using SpecifiedCurvature = std::function<double(double share)>;

struct EdgeLengthOptions {
  int samples = 21;     ///< 6..501. Places at which the curvatures of one piece are compared.
  bool pinEnds = true;  ///< Every piece keeps its end. Off: as in the paper the end moves and what follows moves along.
};
struct EdgeLengthResult {
  std::vector<Quintic> path;
  Termination why = Termination::NotRun;
  int iterations = 0;                            ///< Of all pieces.
  double misfitBefore = 0.0, misfitAfter = 0.0;  ///< Rms of the difference of curvature over its largest wanted value.
};

/// Shape modification on a specified curvature (001 section 6, Eq 12 to 16): the directions of the five edges of every
/// control polygon stay, their lengths a_1..a_5 change until the curvature is nearest to the specified one (least
/// squares). Solved for log a by Levenberg-Marquardt: edges never reverse, and large changes do not explode as
/// Gauss-Newton does. Joints keep their direction; neighbours get one curvature there, so the path is G2 where it was
/// G1. Pieces without length in an edge, or with an inflection, stay as they are (the paper assumes none).
EdgeLengthResult followCurvature(std::span<const Quintic> path, const SpecifiedCurvature& wanted,
                                 const EdgeLengthOptions& options, const RunContext& context);

}  // namespace batten
