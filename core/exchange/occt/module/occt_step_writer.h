// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/exchange/occt/module/cad_module.h"

namespace batten {

/// As writeStep().
Result<std::string> stepOf(const PlainDrawing&, const DrawingFigures&, const std::string& title);

}  // namespace batten
