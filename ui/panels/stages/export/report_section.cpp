// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/report_section.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QDate>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <filesystem>
#include <new>

#include "core/base/partial_context.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/save_dialog.h"
#include "ui/panels/stages/export/export_folder.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {

const QString kKindKey = QStringLiteral("report/kind");
enum Kind { PdfOnA4, PdfOnLetter, Html };
constexpr std::array kReportKinds = {PdfOnA4, PdfOnLetter, Html};  // in the order of the list

Result<void> writeReport(const PipelineOutput& output, const Recipe& recipe, const Scan& scan, Kind kind,
                         const std::filesystem::path& path, const RunContext& context) {
  try {
    const ReportOrigin origin{
        (QStringLiteral("Batten ") + QCoreApplication::applicationVersion()).trimmed().toStdString(),
        QDate::currentDate().toString(Qt::ISODate).toStdString()};
    // The figures take most of the time; the pages follow.
    constexpr double kFiguresPart = 0.8;
    const auto content = reportContent(scan, recipe, output, origin, partialContext(context, 0.0, kFiguresPart));
    if (!content) return fail(content.error());
    return writeReportFile(*content, kind == Html ? ReportFormat::Html : ReportFormat::Pdf,
                           kind == PdfOnLetter ? ReportPaper::Letter : ReportPaper::A4, path,
                           partialContext(context, kFiguresPart, 1.0));
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory for the report. Exclude some curves.");
  }
}

}  // namespace

ReportSection::ReportSection(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      kind_(new QComboBox(this)),
      button_(plainButton(tr("Write report…"), QStringLiteral("report.write"), this)),
      progress_(new QProgressBar(this)),
      result_(note({}, this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(caption(tr("Report"), this));
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  kind_->setObjectName(QStringLiteral("report.kind"));
  kind_->setAccessibleName(tr("Format of the report"));
  kind_->addItems({tr("PDF, A4"), tr("PDF, Letter"), tr("HTML")});
  const bool isLetter = QLocale().measurementSystem() == QLocale::ImperialUSSystem;
  kind_->setCurrentIndex(std::clamp(QSettings().value(kKindKey, isLetter ? PdfOnLetter : PdfOnA4).toInt(), 0, 2));
  button_->setToolTip(tr("The drawing at 1:1, measurements of every curve, comb, radius, deviations and the recipe."));
  row->addWidget(kind_);
  row->addWidget(button_, 1);
  layout->addLayout(row);
  progress_->setObjectName(QStringLiteral("report.progress"));
  progress_->setAccessibleName(tr("Progress of the report"));
  progress_->setRange(0, 100);
  progress_->setTextVisible(false);
  progress_->hide();
  layout->addWidget(progress_);
  result_->setObjectName(QStringLiteral("report.result"));
  layout->addWidget(result_);
  connect(kind_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [](int kind) { QSettings().setValue(kKindKey, kind); });
  connect(button_, &QPushButton::clicked, this, &ReportSection::choose);
  connect(&session_, &EditorSession::stopped, this, [this] {
    if (isRunning_) cancel_.cancel();
  });
}

ReportSection::~ReportSection() { cancel_.cancel(); }

void ReportSection::setReady(bool ready) {
  isReady_ = ready;
  button_->setEnabled(ready && !isRunning_);
}

void ReportSection::clearResult() { result_->clear(); }

void ReportSection::choose() {
  const bool isHtml = kind_->currentIndex() == Html;
  const QString suffix = isHtml ? QStringLiteral("html") : QStringLiteral("pdf");
  const QString proposed = proposedExportPath(session_, QStringLiteral(".report.") + suffix);
  const QString path =
      askSavePath(this, {tr("Write report"), proposed, isHtml ? tr("HTML (*.html)") : tr("PDF (*.pdf)"), suffix});
  if (!path.isEmpty()) write(path);
}

void ReportSection::write(const QString& path) {
  if (isRunning_ || !session_.output().faired) return;
  isRunning_ = true;
  progress_->setValue(0);
  progress_->show();
  clearResult();
  setReady(isReady_);
  session_.setSideWork(this, true, false);
  const Kind kind = kReportKinds.at(kind_->currentIndex());
  cancel_ = worker_->start(
      [this, output = session_.output(), recipe = session_.recipe(), scan = session_.scan(), kind,
       path](const CancelToken& cancel) {
        RunContext context;
        context.cancel = cancel;
        context.progress = [this](double fraction) {
          inbox_.post([this, fraction] { progress_->setValue(static_cast<int>(100.0 * fraction)); });
        };
        const auto outcome = writeReport(output, recipe, *scan, kind, nativePath(path), context);
        inbox_.post([this, outcome, path] { finish(outcome, path); });
      },
      BackgroundWorker::Running::Finish);
}

void ReportSection::finish(const Result<void>& outcome, const QString& path) {
  isRunning_ = false;
  progress_->hide();
  session_.setSideWork(this, false);
  setReady(isReady_);
  if (!outcome && outcome.error().code != ErrorCode::Cancelled) return emit failed(outcome.error());
  result_->setText(outcome ? tr("Wrote %1.").arg(shownFileName(path)) : tr("Stopped. No report was written."));
  emit written(result_->text());
}

}  // namespace batten
