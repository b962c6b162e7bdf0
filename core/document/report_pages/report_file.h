// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "core/document/report_pages/report_pdf.h"

namespace batten {

enum class ReportFormat { Pdf, Html };
/// By the end of a name, whatever its case: ".report.pdf" and ".report.html". Absent for all others.
std::optional<ReportFormat> reportFormatOf(const std::filesystem::path&);

/// Writes the report, whole or not at all. @return CannotWrite, Cancelled.
Result<void> writeReportFile(const ReportContent&, ReportFormat, ReportPaper, const std::filesystem::path&,
                             const RunContext& = {});

}  // namespace batten
