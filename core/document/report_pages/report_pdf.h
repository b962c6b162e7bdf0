// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/run_context.h"
#include "core/document/report_pages/report_content.h"

namespace batten {

enum class ReportPaper { A4, Letter };

/// The report as a PDF of vector pages: an overview with the drawing 1:1 if it fits below, else sheets with the drawing
/// 1:1 that overlap by 10 mm and can be put together at their marks, each with a bar of 100 mm; then the tables and two
/// figures a curve. Beyond 40 sheets the drawing is reduced to one, and the sheet says by how much. The recipe is
/// attached as a file.
/// Any thread. @return Cancelled; CannotWrite if the pages could not be made, or without a QGuiApplication and its
/// fonts.
Result<std::string> reportPdf(const ReportContent&, ReportPaper, const RunContext& = {});

}  // namespace batten
