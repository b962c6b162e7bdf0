// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/report_output.h"

#include <QDate>
#include <QGuiApplication>
#include <array>
#include <memory>

namespace batten::cli {

Result<void> writeReportPages(const std::vector<OutputPlan::ReportPages>& reports, const Scan& scan,
                              const Recipe& recipe, const PipelineOutput& output, const RunContext& context) {
  if (reports.empty()) return {};
  // Qt lays out text only for a program with a window system; this one of Qt's own shows nothing.
  static char program[] = "batten-cli", option[] = "-platform", platform[] = "offscreen";
  std::array<char*, 4> words = {program, option, platform, nullptr};
  int count = 3;
  // What it says of the machine, as of a missing folder of the desktop, is no error of the trace.
  const auto before = qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  std::unique_ptr<QGuiApplication> fonts;
  if (QCoreApplication::instance() == nullptr) fonts = std::make_unique<QGuiApplication>(count, words.data());
  qInstallMessageHandler(before);
  const ReportOrigin origin{std::string("Batten ") + BATTEN_VERSION,
                            QDate::currentDate().toString(Qt::ISODate).toStdString()};
  const auto content = reportContent(scan, recipe, output, origin, context);
  if (!content) return fail(content.error());
  for (const auto& report : reports) {
    if (auto written = writeReportFile(*content, report.format, report.paper, report.path, context); !written)
      return written;
  }
  return {};
}

}  // namespace batten::cli
