// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"
#include "core/image/sheet/binding_holes.h"
#include "core/image/sheet/paper_sheet.h"

namespace batten {

/// The sheet that was drawn on, and what was punched into it.
struct SheetAndHoles {
  std::optional<BindingHoles> holes;  ///< Absent: none were found.
  std::optional<PaperSheet> sheet;    ///< Absent: the paper fills the picture, or where it ends is doubtful.
};

/// Both are found on one set of cells. Empty when cancelled.
SheetAndHoles findSheetAndHoles(const GreyImage&, const ColourImage&, const RunContext&);

}  // namespace batten
