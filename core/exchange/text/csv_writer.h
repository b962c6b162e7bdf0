// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"
#include "core/exchange/model/export_settings.h"

namespace batten {

/// Stands in the comment of the file before the number of its rows, so that a reader sees whether rows are missing.
inline constexpr std::string_view kRowsStated = "Rows: ";

/// Places along every curve for a spreadsheet: arc length, x, y, direction [degrees], curvature and radius, at equal
/// steps of arc length of at most `settings.spacingMm`, both ends included. Units in the names of the columns, the sign
/// convention in a line that begins with #; UTF-8, comma, dot. The radius of a straight place is empty.
Result<std::string> writeCsv(const ExportDocument&, const ExportSettings&, const RunContext& = {});

/// The largest distance of the rows of such a file from the curves at their arc length, in mm.
/// @return CannotWrite if it holds other curves or other rows, Cancelled.
Result<double> checkCsv(std::string_view text, const ExportDocument&, const ExportSettings&, const RunContext& = {});

}  // namespace batten
