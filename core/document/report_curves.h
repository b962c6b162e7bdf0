// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/document/report.h"
#include "core/document/report_values.h"

namespace batten {

/// What the report says of every curve of a run.
ReportJson curvesToJson(const PipelineOutput& out, const Recipe& recipe, const ReportExtras& extras);

/// More curves than this are not all compared with each other.
inline constexpr std::ptrdiff_t kMostCompared = 60;

}  // namespace batten
