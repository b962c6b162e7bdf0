// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "core/exchange/occt/module/cad_module.h"

namespace batten {

/// As readStep().
Result<PlainDrawing> drawingOfStep(std::string_view bytes);

}  // namespace batten
