// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/exchange/model/cubic_path.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// The ink of a stroke as an area: its middle, half its width to either side. Model frame, mm.
struct WidthOutline {
  /// Closed loops of cubics. A stroke has one, anticlockwise; a ring has two that run against each other. Filled by the
  /// nonzero rule: where a stroke crosses itself, its outline does, too.
  std::vector<CubicRun> loops;
  int cubics = 0;
};

/// The outlines of the pieces of a line that have a width; pieces that meet have one together, round at corners on the
/// outside. Ends are round, or pointed where the width is 0. Where the line turns more tightly than half its width, the
/// inner border ends where it meets itself and leaves no loop.
/// @param tolerance [mm] of the cubics from the borders. > 0.
WidthOutline widthOutline(const ExportCurve&, double tolerance, CancelCheck check = {});

}  // namespace batten
