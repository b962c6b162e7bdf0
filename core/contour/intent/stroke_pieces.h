// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/intent/strips.h"

namespace batten {

/// A stretch of a line between two places at which the line may have gone from one intended curve into another.
struct StrokePiece {
  Strip strip;                        ///< Its samples.
  int line = 0;                       ///< Of the lines given.
  int firstPoint = 0, lastPoint = 0;  ///< Of the line, both included; on a ring the last may run past the end.
};

/// Two pieces that follow each other on a line. Ends are numbered 2 * piece + side, 0 at the start and 1 at the end.
struct TraceLink {
  int from = 0, to = 0;  ///< The end of the one, the start of the other.
  bool isCorner = false;
};

struct StrokePieceSet {
  std::vector<StrokePiece> pieces;
  std::vector<TraceLink> links;
};

/// Cuts lines at corners (turn_cuts.h), where another line ends on them (within 1.6 widths), and where another or
/// they themselves cross them. No piece is shorter than 3 widths: crossings give way to ends, ends to corners. An end
/// is free where no other ink lies within 2 widths. Not complete when cancelled.
/// @param lines without bridged gaps. @param widthPx > 0, of the pen.
StrokePieceSet cutIntoPieces(const std::vector<Contour>& lines, double widthPx, const RunContext& context);

}  // namespace batten
