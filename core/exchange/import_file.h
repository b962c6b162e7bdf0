// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/imported_line.h"
#include "core/exchange/point_file.h"

namespace batten {

/// What a file of curves or points holds, and what should be said of it.
struct ImportReport {
  ImportedFile file;
  std::vector<std::string> notes;  ///< The unit was assumed, something was left out ….
  std::vector<NamedPart> parts;    ///< Of lines of points: what their file calls the parts between two corners.
};

/// Reads lines to make fair: DXF, IGES, STEP, any SVG (of Batten's own the exact curves), curve JSON, points as CSV or
/// JSON; the ending says which. Curves that follow each other in the file and meet become one line with a corner where
/// they meet; polylines of chords become points, with corners where they turn sharply, other shapes curves.
/// @param mmPerUnit instead of what the file states, not for SVG and Batten's own files; absent: as stated, else mm.
/// @return BadParameter with what to do if it cannot be read, NoCurve if it holds no line, Cancelled.
Result<ImportReport> readImportFile(const std::filesystem::path&, std::optional<double> mmPerUnit = {},
                                    const RunContext& context = {});

/// Whether a file is one of these by the ending of its name; JSON is not told from recipes so.
bool isImportName(const std::filesystem::path&);
/// For file dialogs and messages: ".dxf, .igs, …".
std::string importEndings();

}  // namespace batten
