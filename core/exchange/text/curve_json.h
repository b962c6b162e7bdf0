// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// Curve JSON, "batten-curves" version 1 (help page on file formats); numbers with 17 significant digits.
/// @return NoCurve if there is nothing to write, Cancelled.
Result<std::string> writeCurveJson(const ExportDocument&, const RunContext& context = {});
/// Reads curve JSON back: for the self-check after an export, and to compare curves. Damage and attacks end early
/// (json_text.h); a cancel is heard.
Result<ExportDocument> readCurveJson(std::string_view text, const RunContext& context = {});

}  // namespace batten
