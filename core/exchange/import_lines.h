// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/vec2.h"
#include "core/curve/imported_line.h"
#include "core/exchange/model/cad_shape.h"
#include "core/exchange/model/export_model.h"

namespace batten {

struct DrawingLines {
  std::vector<ImportedLine> lines;  ///< [mm]
  int left = 0;                     ///< Entities of which no line can be made.
};

/// Lines of the entities of a drawing, in their order: those that meet one after the other are one line.
DrawingLines linesOf(const CadDrawing&, double mmPerUnit);

/// Lines of Batten's own files; where the curves of one leave a gap it becomes two.
std::vector<ImportedLine> linesOf(const ExportDocument&);

/// The points of a polyline at which it turns sharply. A line of measured points trembles at each of them: there a turn
/// counts as far as it is seen over more of the line, or moves farther than a tremor does.
std::vector<int> sharpPoints(const std::vector<Vec2>& points, bool closed);

/// At how many places a line turns sharply: corners of points, and straight curves that meet at an angle.
std::size_t sharpTurnsOf(const ImportedLine&);

/// Gives a line of points its corners. One of many points that turns sharply at most of them is a polygon: its points
/// give way to its sides, which are exact, as those of a path are.
void findCorners(ImportedLine&);

}  // namespace batten
