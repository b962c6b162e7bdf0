// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/pipeline/recipe/parameter_table.h"

namespace batten::table {

/// The parameters of fairing, as a part of the table.
std::vector<Parameter> fairingParameters();

}  // namespace batten::table
