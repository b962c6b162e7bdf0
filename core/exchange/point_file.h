// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/imported_line.h"

namespace batten {

/// Lines of points as a file gives them.
struct PointFile {
  std::vector<ImportedLine> lines;  ///< Points in the unit of the file, y up; without corners.
  std::optional<double> mmPerUnit;  ///< Absent: the file does not say.
  int left = 0;                     ///< Rows or lines that hold no points.
};

/// Points of a table: two columns x and y, parted by comma, semicolon, tab or blanks; further columns are passed over.
/// A row of names may stand first: columns whose names begin with x and y are taken (x_mm, y_in, "x [mm]" say the
/// unit), one called curve, line or name parts lines from each other; so Batten's own CSV is read, too. An empty row
/// parts lines as well. Rows that begin with # are comments; a line ends where it began: it is closed. With semicolons
/// or tabs a comma may stand for the dot.
/// @return BadParameter with the row that cannot be read; NoCurve if no line has two points.
Result<PointFile> readPointTable(std::string_view text, const RunContext& context = {});

/// Points as JSON: [[x, y], …], a list of such lists, or {"unit": "mm", "lines": [{"name": "roof", "closed": false,
/// "points": [[x, y], …]}, …]}. @return as readPointTable.
Result<PointFile> readPointJson(std::string_view text, const RunContext& context = {});

/// [mm] "mm", "cm", "m", "in" or "inch"; absent for others.
std::optional<double> millimetresOfUnit(std::string_view unit);

}  // namespace batten
