// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "app/cli/trace_plan.h"
#include "core/base/run_context.h"
#include "core/pipeline/run/pipeline.h"

namespace batten::cli {

/// Writes the reports to print of a finished run. Needs no display.
Result<void> writeReportPages(const std::vector<OutputPlan::ReportPages>&, const Scan&, const Recipe&,
                              const PipelineOutput&, const RunContext&);

}  // namespace batten::cli
