// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/exchange/cad_shape.h"

namespace batten {

/// Reads the curves of the geometric sets of a STEP file, z left out; the others of the sets are counted in `left`.
Result<CadDrawing> readStep(std::string_view bytes);

}  // namespace batten
