// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/page_frame.h"
#include "core/curve/imported_line.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// The recipe of a drawing without a scan that holds these lines: a page around them, about 2000 px at its longer side,
/// that lies where they are.
Recipe drawingOf(ImportedFile);

/// The recipe with the lines of a file behind its own, where their coordinates put them. Where they miss the page of a
/// scan altogether, their middle is put on the middle of the page; `moved` says so. @param frame of the page.
struct AddedImport {
  Recipe recipe;
  bool moved = false;
};
AddedImport withImport(Recipe recipe, ImportedFile file, const PageFrame& frame);

}  // namespace batten
