// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/export_panel.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <filesystem>

#include "core/pipeline/run/pipeline.h"
#include "ui/panels/controls/lines_note.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/path_edit.h"
#include "ui/panels/controls/save_dialog.h"
#include "ui/panels/controls/stage_panel.h"
#include "ui/panels/stages/export/export_choice.h"
#include "ui/panels/stages/export/export_options.h"
#include "ui/panels/stages/export/export_preview.h"
#include "ui/panels/stages/export/report_section.h"
#include "ui/panels/stages/export/svg_carrier.h"
#include "ui/session/background/background_worker.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/edits/direction_edits.h"
#include "ui/session/files/path_text.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

/// What is shown below the button.
enum StatusPage { kResultPage, kProgressPage, kAgainPage };

/// A name without the ending of an export, if it has one.
QString withoutEnding(const QString& name) {
  if (const auto format = formatOf(nativePath(name))) {
    for (const char* ending : endingsOf(*format))
      if (name.endsWith(QLatin1String(ending), Qt::CaseInsensitive)) return name.chopped(qsizetype(qstrlen(ending)));
  }
  return name;
}

}  // namespace

ExportPanel::ExportPanel(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      options_(new ExportOptions(this)),
      choice_(new ExportChoice(session, this)),
      preview_(new ExportPreview(this)),
      held_(new LinesNote(1, this)),
      turn_(linkButton(tr("Reverse direction"), QStringLiteral("export.turn"), this)),
      carrier_(new SvgCarrier(this)),
      report_(new ReportSection(session, this)),
      progress_(new QProgressBar(this)),
      path_(new PathEdit(this)),
      browse_(plainButton(tr("Choose…"), QStringLiteral("export.browse"), this)),
      size_(new LinesNote(3, this)),
      export_(plainButton(tr("Export"), QStringLiteral("export.run"), this)),
      again_(linkButton(tr("Compute again"), QStringLiteral("export.again"), this)),
      result_(new LinesNote(3, this)),
      status_(new QStackedWidget(this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  buildForm();
  connect(options_, &ExportOptions::formatChanged, this, [this] {
    confirmReplace_ = false;
    suggestName();
  });
  connect(options_, &ExportOptions::changed, this, &ExportPanel::refresh);
  connect(choice_, &ExportChoice::changed, this, &ExportPanel::refresh);
  connect(preview_, &ExportPreview::changed, this, &ExportPanel::refresh);
  connect(preview_, &ExportPreview::chosen, this,
          [this](int number) { session_.selectCurve(curveOfNumber(session_, number)); });
  connect(preview_, &ExportPreview::dragAsked, this, &ExportPanel::dragOut);
  connect(turn_, &QPushButton::clicked, this, [this] { reverseCurve(session_, session_.selectedCurve()); });
  connect(carrier_, &SvgCarrier::copied, this, &ExportPanel::said);
  connect(carrier_, &SvgCarrier::failed, this, &ExportPanel::failed);
  connect(report_, &ReportSection::written, this, &ExportPanel::said);
  connect(report_, &ReportSection::failed, this, &ExportPanel::failed);
  connect(carrier_, &SvgCarrier::copied, result_, &QLabel::setText);
  connect(&session_, &EditorSession::selectionChanged, this, &ExportPanel::refresh);
  connect(&session_, &EditorSession::stopped, this, [this] {
    if (running_) cancel_.cancel();
  });
  connect(path_, &QLineEdit::textEdited, this, [this] {
    confirmReplace_ = false;
    refresh();
  });
  connect(browse_, &QPushButton::clicked, this, &ExportPanel::browse);
  connect(export_, &QPushButton::clicked, this, &ExportPanel::start);
  connect(again_, &QPushButton::clicked, &session_, &EditorSession::computeAgain);
  connect(&session_, &EditorSession::scanOpened, this, &ExportPanel::openedAnother);
  connect(&session_, &EditorSession::recipeChanged, this, [this] {
    confirmReplace_ = false;
    result_->clear();
    report_->clearResult();
    emit exported(false);
    refresh();
  });
  connect(&session_, &EditorSession::runFinished, this, &ExportPanel::refresh);
  connect(&session_, &EditorSession::busyChanged, this, &ExportPanel::refresh);
  connect(&session_, &EditorSession::workingChanged, this, &ExportPanel::refresh);
  suggestName();
}

ExportPanel::~ExportPanel() = default;

void ExportPanel::buildForm() {
  auto* layout = panelColumn(this, tr("Export"));
  layout->addWidget(options_);
  layout->addWidget(choice_, 1);
  layout->addWidget(caption(tr("What will be written"), this));
  layout->addWidget(preview_);
  held_->setObjectName(QStringLiteral("export.held"));
  layout->addWidget(held_);
  auto* hand = new QHBoxLayout;
  hand->setSpacing(8);
  turn_->setToolTip(tr("Reverse the direction of the selected curve.  (Shift+F)"));
  hand->addWidget(turn_);
  hand->addStretch();
  auto* copyButton = linkButton(tr("Copy as SVG"), QStringLiteral("export.copy"), this);
  copyButton->setToolTip(tr("Copy the curves to the clipboard for pasting into a drawing program.  (Ctrl+Shift+C)"));
  connect(copyButton, &QPushButton::clicked, this, &ExportPanel::copy);
  hand->addWidget(copyButton);
  layout->addLayout(hand);
  layout->addWidget(caption(tr("File"), this));
  auto* file = new QHBoxLayout;
  file->setSpacing(8);
  path_->setObjectName(QStringLiteral("export.path"));
  path_->setAccessibleName(tr("File to write"));
  size_->setObjectName(QStringLiteral("export.note"));
  file->addWidget(path_, 1);
  file->addWidget(browse_);
  layout->addLayout(file);
  layout->addWidget(size_);
  export_->setProperty("primary", true);
  layout->addWidget(export_);
  preview_->keepInSight(export_);
  progress_->setObjectName(QStringLiteral("export.progress"));
  progress_->setAccessibleName(tr("Progress of the export"));
  progress_->setRange(0, 100);
  progress_->setTextVisible(false);
  result_->setObjectName(QStringLiteral("export.result"));
  // One place for all that may stand there: the report below keeps its own.
  for (QWidget* one :
       {static_cast<QWidget*>(result_), static_cast<QWidget*>(progress_), static_cast<QWidget*>(again_)}) {
    auto* page = new QWidget(status_);
    auto* rows = new QVBoxLayout(page);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->addWidget(one, 0, one == again_ ? Qt::AlignLeft : Qt::Alignment());
    rows->addStretch();
    status_->addWidget(page);
  }
  status_->setFixedHeight(result_->height());
  layout->addWidget(status_);
  layout->addWidget(report_);
  layout->addStretch();
}

void ExportPanel::openedAnother() {
  lastWritten_.reset();
  result_->clear();
  report_->clearResult();
  confirmReplace_ = false;
  // The folder that was chosen stays; the name is the new drawing's, or its export would replace the old one's.
  choice_->reset();
  if (path_->isModified()) rememberExportFolder(path_->text());
  path_->clear();
  path_->setModified(false);
  suggestName();
}

void ExportPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void ExportPanel::suggestName() {
  const QString suffix = options_->suffix();
  if (!path_->text().isEmpty() && path_->isModified()) {
    const QFileInfo now(path_->text());
    path_->setText(now.path() + QLatin1Char('/') + withoutEnding(now.fileName()) + QLatin1Char('.') + suffix);
    path_->setModified(true);
  } else if (session_.hasScan()) {
    path_->setText(proposedExportPath(session_, QLatin1Char('.') + suffix));
    path_->setCursorPosition(static_cast<int>(path_->text().size()));
  }
  path_->setToolTip(shownPath(path_->text()));
  refresh();
}

void ExportPanel::browse() {
  const QString chosen = askSavePath(this, {tr("Export"), path_->text(), options_->filter(), options_->suffix()});
  if (chosen.isEmpty()) return;
  path_->setText(chosen);
  path_->setModified(true);
  path_->setToolTip(shownPath(chosen));
  // The dialog has asked about an existing file already.
  confirmReplace_ = true;
  refresh();
}

bool ExportPanel::isReady() const {
  return session_.hasScan() && session_.output().faired && !session_.isBusy() && !session_.isStale(StageId::Faired);
}

const ExportSize& ExportPanel::size() {
  auto numbers = choice_->numbers();
  if (sizeOf_ != session_.output().faired || sizeWhich_ != options_->which() || sizeNumbers_ != numbers) {
    sizeOf_ = session_.output().faired;
    sizeWhich_ = options_->which();
    sizeNumbers_ = std::move(numbers);
    measured_ = exportSize(session_.output(), sizeWhich_, sizeNumbers_);
  }
  return measured_;
}

QString ExportPanel::reasonToWait() const {
  if (const QString missing = options_->obstacle(); !missing.isEmpty()) return missing;
  if (!session_.hasScan()) return tr("Open a scan first.");
  if (session_.isBusy()) return tr("Still computing.");
  if (session_.isStale(StageId::Faired) || !session_.output().faired) {
    if (session_.isStopped()) return tr("The computation was stopped: compute again to export.");
    if (session_.output().error) return QString::fromStdString(session_.output().error->message);
  }
  return {};
}

void ExportPanel::refresh() {
  const bool wasStopped = !session_.isWorking() && session_.isStopped() && session_.isStale(StageId::Faired);
  status_->setCurrentIndex(wasStopped ? kAgainPage : running_ ? kProgressPage : kResultPage);
  // Measured and looked for on the disk only while someone reads it.
  if (!isVisible()) return;
  choice_->refresh();
  refreshPreview();
  const ExportSize size = session_.hasScan() ? this->size() : ExportSize{};
  export_->setEnabled(isReady() && options_->obstacle().isEmpty() && size.curves > 0 &&
                      !path_->text().trimmed().isEmpty());
  report_->setReady(isReady() && size.curves > 0);
  turn_->setEnabled(session_.selectedCurve().has_value());
  held_->setText(summary(size));
  const bool exists = confirmReplace_ && isOfOthers(path_->text());
  export_->setText(running_ ? tr("Writing…") : exists ? tr("Replace the file") : tr("Export"));
  if (const QString reason = reasonToWait(); !reason.isEmpty()) return size_->setText(reason);
  if (size.curves == 0) {
    const QString nothing = choice_->obstacle();
    return size_->setText(nothing.isEmpty() ? tr("There is no curve to export yet.") : nothing);
  }
  const ExportSettings settings = options_->settings();
  const double width = size.widthMm * settings.scale, height = size.heightMm * settings.scale;
  QString text = tr("Will import as %1\u00a0×\u00a0%2\u00a0mm").arg(width, 0, 'f', 1).arg(height, 0, 'f', 1);
  if (settings.unit == LengthUnit::Inch) {
    const double inch = millimetresPer(LengthUnit::Inch);
    text += tr(" (%1\u00a0×\u00a0%2\u00a0in)").arg(width / inch, 0, 'f', 3).arg(height / inch, 0, 'f', 3);
  }
  text += QLatin1Char('.');
  if (isScaleAssumed(*session_.scan(), session_.recipe()))
    text += tr(" The scale is not known: set the resolution in the Scan stage.");
  if (settings.format == ExportFormat::Iges || settings.format == ExportFormat::Step)
    text +=
        tr(" The file contains curves only: if nothing appears, enable wireframe import in the "
           "other program.");
  size_->setText(text);
}

/// What was typed, with the ending of the format: that of another one is replaced.
QString ExportPanel::wantedPath() const {
  const QString typed = QFileInfo(path_->text().trimmed()).absoluteFilePath();
  const auto format = formatOf(nativePath(typed));
  if (format && *format != options_->settings().format)
    return withoutEnding(typed) + QLatin1Char('.') + options_->suffix();
  return withSuffix(typed, options_->suffix());
}

bool ExportPanel::isOfOthers(const QString& path) const {
  const auto now = stateOfFile(path);
  return now && now != lastWritten_;
}

ExportRequest ExportPanel::request(const QString& path) const {
  return {session_.output(), session_.recipe(), session_.scan(),   options_->settings(),
          options_->which(), nativePath(path),  choice_->numbers()};
}

// Asked for when anything that it shows has changed, and not with every refresh.
void ExportPanel::refreshPreview() {
  if (!isReady()) {
    if (!previewed_) return;
    previewed_.reset();
    return preview_->clear();
  }
  const ExportSettings settings = options_->settings();
  const Previewed now{session_.output().faired,
                      session_.recipe().directions,
                      session_.recipe().starts,
                      options_->which(),
                      choice_->numbers(),
                      isJoined(settings),
                      settings.scale};
  if (previewed_ == now) return;
  previewed_ = now;
  preview_->show(request({}));
}

QString ExportPanel::summary(const ExportSize& size) const {
  const PreviewContent& content = preview_->content();
  if (content.curves.empty() || size.curves == 0) return {};
  QString text = counted(size.curves, tr("1 curve"), tr("%1 curves"));
  if (options_->settings().joined.value_or(false) && std::ssize(content.curves) < size.curves)
    text = tr("%1 joined into %2").arg(text).arg(std::ssize(content.curves));
  if (content.layers > 1) text += tr(" on %1 layers").arg(content.layers);
  if (content.doubles > 0) text += counted(content.doubles, tr(", 1 duplicate omitted"), tr(", %1 duplicates omitted"));
  return text + QLatin1Char('.');
}

void ExportPanel::copy() {
  if (!isReady() || size().curves == 0) return;
  carrier_->copy(request({}));
}

void ExportPanel::dragOut(std::optional<int> number) {
  if (!isReady()) return;
  const QString name = number ? tr("Curve %1").arg(*number) : QFileInfo(session_.scanPath()).completeBaseName();
  carrier_->drag(request({}), number, name.isEmpty() ? QStringLiteral("drawing") : name);
}

void ExportPanel::start() {
  if (!isReady() || running_) return;
  const QString path = wantedPath();
  if (path != path_->text()) {
    path_->setText(path);
    path_->setModified(true);
  }
  if (isOfOthers(path) && !confirmReplace_) {
    confirmReplace_ = true;
    const QString name = shownFileName(path);
    result_->setText(
        lastWritten_ && path == lastWritten_->path
            ? tr("%1 was changed by another program after the export. Press again to replace it.").arg(name)
            : tr("%1 exists. Press again to replace it.").arg(name));
    return refresh();
  }
  ExportRequest request = this->request(path);
  running_ = true;
  progress_->setValue(0);
  session_.setSideWork(this, true, false);
  writing_ = session_.recipe();
  if (path_->isModified()) rememberExportFolder(path);
  result_->clear();
  refresh();
  cancel_ = worker_->start(
      [this, request = std::move(request)](const CancelToken& cancel) {
        RunContext context;
        context.cancel = cancel;
        context.progress = [this](double fraction) {
          inbox_.post([this, fraction] { progress_->setValue(static_cast<int>(100.0 * fraction)); });
        };
        const auto outcome = runExport(request, context);
        inbox_.post([this, outcome] { finish(outcome); });
      },
      BackgroundWorker::Running::Finish);
}

void ExportPanel::finish(const Result<ExportReport>& report) {
  running_ = false;
  confirmReplace_ = false;
  session_.setSideWork(this, false);
  if (!report) {
    refresh();
    if (report.error().code == ErrorCode::Cancelled) return result_->setText(tr("Stopped. Nothing was written."));
    emit failed(report.error());
    return;
  }
  const QString written = pathText(report->path);
  lastWritten_ = stateOfFile(written);
  result_->setText(tr("Wrote %1: %2.").arg(shownFileName(written), QString::fromStdString(sentenceByNumbers(*report))));
  refresh();
  // A change made meanwhile is not in the file.
  emit exported(writing_ == session_.recipe());
}

}  // namespace batten
