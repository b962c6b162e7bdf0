// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/exchange/export_model.h"

namespace batten {

/// Curve JSON, "batten-curves" version 1 (see README); numbers with 17 significant digits.
Result<std::string> writeCurveJson(const ExportDocument&);
/// Reads curve JSON back (the self-check after an export, and tests).
Result<ExportDocument> readCurveJson(std::string_view text);

}  // namespace batten
