// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/exchange/model/export_model.h"

namespace batten {

/// Imported open lines of one layer become one wherever exactly two of their ends meet (within a millionth of their
/// size): in any order, some of them reversed. The first line of a chain keeps its direction, name and place in the
/// list, unless the user chose the direction of another one. Other lines stay as they are.
std::vector<ExportCurve> joinedLines(std::vector<ExportCurve> lines);

}  // namespace batten
