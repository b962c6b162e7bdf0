// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/curve/imported_line.h"

namespace batten {

/// Lines of other programs as they stand in a recipe, with numbers that read back exactly, mm:
/// [{"source":"roof.dxf","unit":"mm","lines":[{"name":"roof","layer":"body","closed":false,
/// "curves":[{"name":"roof 1","degree":3,"knots":[…],"points":[[x,y]…],"weights":[…]}…]} or
/// {…,"points":[[x,y]…],"corners":[3,9]}…]}…]
nlohmann::ordered_json importsToJson(const std::vector<ImportedFile>&);
/// @return BadParameter that says what is damaged.
Result<std::vector<ImportedFile>> importsFromJson(const nlohmann::ordered_json&);

}  // namespace batten
