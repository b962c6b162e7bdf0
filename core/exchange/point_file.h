// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/imported_line.h"

namespace batten {

/// A part of a line of points, from one corner to the next, as its file names it.
struct NamedPart {
  std::size_t line = 0;  ///< Which line of the file.
  std::size_t part = 0;  ///< Counted from the first point of the line on.
  std::string name;      ///< UTF-8; not empty.
};

/// Lines of points as a file gives them.
struct PointFile {
  std::vector<ImportedLine> lines;  ///< Points in the unit of the file, y up; corners only of lines with parts.
  std::optional<double> mmPerUnit;  ///< Absent: the file does not say.
  int left = 0;                     ///< Rows or lines that hold no points.
  std::vector<NamedPart> parts;     ///< Of lines whose corners the file states by naming its parts.
  std::vector<std::string> notes;   ///< What else is to be said of the file.
};

/// Points of a table: two columns x and y, parted by comma, semicolon, tab or blanks; further columns are passed over.
/// A row of names may stand first: columns whose names begin with x and y are taken (x_mm, y_in, "x [mm]" say the
/// unit), one called curve, line or name parts lines from each other; so Batten's own CSV is read, too. An empty row
/// parts lines as well. Rows that begin with # are comments; a line ends where it began: it is closed. With semicolons
/// or tabs a comma may stand for the dot. Every row holds as many fields as the first one, or more: a file that was cut
/// is refused. Of Batten's own CSV, which names curves and pieces, the end of the last row and the number of rows that
/// the file states are looked at, too; its sketched curves get the layer "Sketched".
/// @return BadParameter with the row that cannot be read; NoCurve if no line has two points.
Result<PointFile> readPointTable(std::string_view text, const RunContext& context = {});

/// Points as JSON: [[x, y], …], a list of such lists, or {"unit": "mm", "lines": [{"name": "roof", "closed": false,
/// "points": [[x, y], …]}, …]}. @return as readPointTable.
Result<PointFile> readPointJson(std::string_view text, const RunContext& context = {});

/// [mm] "mm", "cm", "m", "in" or "inch"; absent for others.
std::optional<double> millimetresOfUnit(std::string_view unit);

}  // namespace batten
