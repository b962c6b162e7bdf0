// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "core/base/page_frame.h"
#include "core/base/result.h"
#include "core/curve/imported_line.h"
#include "core/exchange/point_file.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// The recipe of a drawing without a scan that holds these lines: a page around them, about 2000 px at its longer side,
/// that lies where they are. Curves that Batten named ("Curve 3") keep their numbers.
/// @param parts of lines of points, as ImportReport has them.
Recipe drawingOf(ImportedFile, std::span<const NamedPart> parts = {});

/// The recipe with the lines of a file behind its own, where their coordinates put them. Where they miss the page of a
/// scan altogether, their middle is put on the middle of the page; `moved` says so. @param frame of the page.
struct AddedImport {
  Recipe recipe;
  bool moved = false;
};
AddedImport withImport(Recipe recipe, ImportedFile file, const PageFrame& frame);

/// [mm] What one unit of the file was taken for. Absent if its name says nothing.
std::optional<double> millimetresOfImport(const ImportedFile&);

/// The recipe with the lines of one of its imports read in another unit: "mm", "cm", "m" or "in". They grow about the
/// origin. A drawing that is made of this file alone keeps its picture, since its page grows with them; on the page of
/// a scan, or beside other lines, they lie where withImport() would put them.
/// @param frame of the page. @return BadParameter if the unit is none, or the lines would be too large.
Result<Recipe> withImportUnit(Recipe recipe, std::size_t import, const std::string& unit, const PageFrame& frame);

}  // namespace batten
