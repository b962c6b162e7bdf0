// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/page_frame.h"
#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/corner/corner_marks.h"
#include "core/curve/imported_line.h"

namespace batten {

/// [px] Distance of the points of imported contours: a pixel, and more where that would make over a million points of
/// all lines together.
double importStepPx(std::span<const ImportedFile>, const PageFrame&);

/// `set` with the lines of other programs behind its own, with one point about every importStepPx(). Where two of their
/// curves meet, and at the corners of points, the line has a joint. Some lines are missing when cancelled.
ContourSet withImports(ContourSet set, std::span<const ImportedFile>, const PageFrame&, const RunContext&);

/// The line that a contour stands for; null for contours of other kinds.
const ImportedLine* importedLineOf(const Contour&, std::span<const ImportedFile>);

/// What the file that a piece comes from calls it, with a number behind it where several pieces share one name. Empty
/// for other lines, for curves without a name, and where the name is one that Batten made ("Curve 3").
std::string importedNameOf(const PieceSet&, std::size_t piece, const ContourSet&, std::span<const ImportedFile>);

/// The curves of the pieces of one imported line, exactly as they were imported: whole, or the part between two corner
/// marks. Absent for lines of points, and where the pieces are none of the line. Model frame, mm.
/// @param stepPx [px] importStepPx() of the drawing
std::vector<std::optional<NurbsCurve>> importedCurves(const ImportedLine&, std::span<const Piece> pieces,
                                                      const PageFrame&, double stepPx);

}  // namespace batten
