// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/exchange/occt/module/cad_module.h"

namespace batten {

/// As writeIges(); `largest`: the largest coordinate of the drawing, which the file states.
Result<std::string> igesOf(const PlainDrawing&, const std::string& title, double largest);

/// As readIges(), of a file by its name: Open CASCADE reads no other.
Result<PlainDrawing> drawingOfIges(const std::string& path);

}  // namespace batten
