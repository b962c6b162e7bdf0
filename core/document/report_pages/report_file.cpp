// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/report_file.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/document/report_pages/report_html.h"
#include "core/exchange/save_atomically.h"

namespace batten {

std::optional<ReportFormat> reportFormatOf(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  if (name.ends_with(".report.pdf")) return ReportFormat::Pdf;
  if (name.ends_with(".report.html")) return ReportFormat::Html;
  return std::nullopt;
}

Result<void> writeReportFile(const ReportContent& content, ReportFormat format, ReportPaper paper,
                             const std::filesystem::path& path, const RunContext& context) {
  if (format == ReportFormat::Html) return saveAtomically(path, reportHtml(content));
  const auto bytes = reportPdf(content, paper, context);
  if (!bytes) return fail(bytes.error());
  if (context.isCancelled()) return cancelled();
  return saveAtomically(path, *bytes);
}

}  // namespace batten
