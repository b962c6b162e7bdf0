// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/cancel_check.h"
#include "core/exchange/model/cubic_path.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// A line of the drawing as what SVG and PDF draw: one path of cubics.
struct CubicOutline {
  std::vector<CubicRun> runs;  ///< More than one where the curves leave a gap.
  bool closed = false;         ///< One run that ends exactly where it starts.
  int cubics = 0;              ///< In all runs.
  double largestError = 0.0;   ///< As measured, see cubic_path.h.
  double largestJump = 0.0;  ///< Likewise; seams and joints of pieces count where the curves have one curvature there.
};

/// The pieces of a line as runs without a gap; pieces share the threads. Where a piece begins where the last one ends,
/// but for rounding, it goes on there, and the shift counts as error. `linear` and `offset` map the curves to the frame
/// of the file.
Result<CubicOutline> cubicOutline(const ExportCurve&, const Eigen::Matrix2d& linear, const Vec2& offset,
                                  const CubicTolerance&, const RunContext& = {});

/// Largest distance of points along cubics, four points each, from the pieces of a line in the same frame; each piece
/// ends where a cubic ends. Infinite if the cubics are no picture of the line.
double distanceFromLine(const std::vector<std::array<Vec2, 4>>& cubics, const ExportCurve&, CancelCheck check = {});

}  // namespace batten
