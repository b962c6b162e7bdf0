// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/image/grey_image.h"
#include "core/image/sheet/paper_sheet.h"

namespace batten {

/// The sheet of a scan that was laid on a blank page, as when it was exported from a document: around it whole rows and
/// columns have the value of the top left pixel, and it begins at straight edges. Absent where a page without grain is
/// drawn on, where paper and margins are alike, and where little is left.
std::optional<PaperSheet> sheetWithinMargins(const GreyImage&);

}  // namespace batten
