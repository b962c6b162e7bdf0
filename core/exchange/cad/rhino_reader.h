// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/exchange/model/cad_shape.h"

namespace batten {

/// Reads the curves of such a file, with their names, layers and unit, and what other programs write to files of the
/// same version and kind; other objects are counted as left.
/// @return BadParameter for damage: a wrong CRC, a chunk that reaches beyond its parent, counts that cannot be.
Result<CadDrawing> readRhino(std::string_view bytes);

}  // namespace batten
