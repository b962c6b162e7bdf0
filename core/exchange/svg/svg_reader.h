// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// Opens an SVG that Batten wrote: the exact curves of its metadata, bit for bit, with their names and layers; the
/// paths are only their picture. The page is that of the file.
/// @return BadParameter if it is damaged, or holds no such curves.
Result<ExportDocument> readSvg(std::string_view text);

}  // namespace batten
