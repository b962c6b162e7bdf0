// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export_panel.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

#include "core/pipeline/run/pipeline.h"
#include "ui/panels/controls/number_field.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/path_edit.h"
#include "ui/panels/controls/save_dialog.h"
#include "ui/panels/controls/segmented_control.h"
#include "ui/panels/controls/setting_name.h"
#include "ui/session/background_worker.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

const QString kFormatKey = QStringLiteral("export/format"), kToleranceKey = QStringLiteral("export/accuracy"),
              kFolderKey = QStringLiteral("export/folder");

}  // namespace

ExportPanel::ExportPanel(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      format_(new SegmentedControl({tr("SVG"), tr("Curve JSON")}, this)),
      path_(new PathEdit(this)),
      browse_(plainButton(tr("Choose…"), QStringLiteral("export.browse"), this)),
      toleranceLabel_(new QLabel(tr("Accuracy of the cubics"), this)),
      tolerance_(new NumberField(this)),
      formatNote_(note({}, this)),
      size_(note({}, this)),
      export_(plainButton(tr("Export"), QStringLiteral("export.run"), this)),
      again_(linkButton(tr("Compute again"), QStringLiteral("export.again"), this)),
      result_(note({}, this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  buildForm();
  connect(format_, &SegmentedControl::chosen, this, [this](int index) { setFormat(static_cast<ExportFormat>(index)); });
  connect(path_, &QLineEdit::textEdited, this, [this] {
    confirmReplace_ = false;
    refresh();
  });
  connect(browse_, &QPushButton::clicked, this, &ExportPanel::browse);
  connect(export_, &QPushButton::clicked, this, &ExportPanel::start);
  connect(again_, &QPushButton::clicked, &session_, &EditorSession::computeAgain);
  connect(tolerance_, &NumberField::committed, this, &ExportPanel::saveSettings);
  connect(&session_, &EditorSession::scanOpened, this, &ExportPanel::openedAnother);
  connect(&session_, &EditorSession::recipeChanged, this, [this] {
    confirmReplace_ = false;
    result_->clear();
    emit exported(false);
    refresh();
  });
  connect(&session_, &EditorSession::runFinished, this, &ExportPanel::refresh);
  connect(&session_, &EditorSession::busyChanged, this, &ExportPanel::refresh);
  connect(&session_, &EditorSession::workingChanged, this, &ExportPanel::refresh);
  QSettings settings;
  tolerance_->setValue(settings.value(kToleranceKey, ExportRequest{}.toleranceMm).toDouble());
  setFormat(settings.value(kFormatKey).toString() == QLatin1String("json") ? ExportFormat::Json : ExportFormat::Svg);
}

ExportPanel::~ExportPanel() = default;

void ExportPanel::buildForm() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(14, 12, 14, 12);
  layout->setSpacing(8);
  layout->addWidget(heading(tr("Export"), this));
  format_->setNames(QStringLiteral("export.format"), {QStringLiteral("svg"), QStringLiteral("json")});
  setSettingName(format_, tr("Export format"));
  layout->addWidget(format_);
  layout->addWidget(formatNote_);
  auto* accuracy = new QHBoxLayout;
  const QString help = tr("SVG knows only cubic curves; they keep this close to the exact ones. Smaller: more cubics.");
  toleranceLabel_->setToolTip(help);
  tolerance_->setToolTip(help);
  tolerance_->setRange(0.0001, 1.0);
  tolerance_->setDecimals(4);
  tolerance_->setStep(0.001);
  tolerance_->setUnit(tr("mm"));
  tolerance_->setFixedWidth(92);
  tolerance_->setValue(ExportRequest{}.toleranceMm);
  tolerance_->edit()->setObjectName(QStringLiteral("export.tolerance"));
  tolerance_->edit()->setAccessibleName(toleranceLabel_->text());
  accuracy->addWidget(toleranceLabel_);
  accuracy->addStretch();
  accuracy->addWidget(tolerance_);
  layout->addLayout(accuracy);
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
  layout->addWidget(again_, 0, Qt::AlignLeft);
  result_->setObjectName(QStringLiteral("export.result"));
  layout->addWidget(result_);
  layout->addStretch();
}

void ExportPanel::setFormat(ExportFormat format) {
  format_->setCurrent(static_cast<int>(format));
  const bool svg = format == ExportFormat::Svg;
  formatNote_->setText(
      svg ? tr("A drawing in mm for illustration and cutting programs. The exact curves are kept in its metadata.")
          : tr("Degree, knots and control points of every curve, in mm and px, without any loss."));
  toleranceLabel_->setVisible(svg);
  tolerance_->setVisible(svg);
  confirmReplace_ = false;
  suggestName();
  saveSettings();
}

QString ExportPanel::suffix() const { return format_->current() == 0 ? QStringLiteral("svg") : QStringLiteral("json"); }

void ExportPanel::saveSettings() const {
  QSettings settings;
  settings.setValue(kFormatKey, suffix());
  settings.setValue(kToleranceKey, tolerance_->value());
}

void ExportPanel::openedAnother() {
  lastWritten_.clear();
  result_->clear();
  confirmReplace_ = false;
  // The folder that was chosen stays; the name is the new drawing's, or its export would replace the old one's.
  if (path_->isModified()) QSettings().setValue(kFolderKey, QFileInfo(path_->text()).absolutePath());
  path_->clear();
  path_->setModified(false);
  suggestName();
}

void ExportPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void ExportPanel::suggestName() {
  const QString suffix = this->suffix();
  if (!path_->text().isEmpty() && path_->isModified()) {
    const QFileInfo now(path_->text());
    path_->setText(now.path() + QLatin1Char('/') + now.completeBaseName() + QLatin1Char('.') + suffix);
    path_->setModified(true);
  } else if (session_.hasScan()) {
    const QFileInfo scan(session_.scanPath());
    QString folder = QSettings().value(kFolderKey).toString();
    if (folder.isEmpty() && !session_.isBlankPage() && !isOfProgram(scan.absoluteFilePath()))
      folder = scan.absolutePath();
    if (folder.isEmpty() || !QFileInfo(folder).isWritable()) folder = QDir::homePath();
    const QString name = session_.isBlankPage() ? QStringLiteral("drawing") : scan.completeBaseName();
    path_->setText(folder + QLatin1Char('/') + name + QLatin1Char('.') + suffix);
    path_->setCursorPosition(static_cast<int>(path_->text().size()));
  }
  path_->setToolTip(path_->text());
  refresh();
}

void ExportPanel::browse() {
  const bool svg = format_->current() == 0;
  const QString chosen =
      askSavePath(this, {tr("Export"), path_->text(), svg ? tr("SVG (*.svg)") : tr("Curve JSON (*.json)"), suffix()});
  if (chosen.isEmpty()) return;
  path_->setText(chosen);
  path_->setModified(true);
  path_->setToolTip(chosen);
  // The dialog has asked about an existing file already.
  confirmReplace_ = true;
  refresh();
}

bool ExportPanel::isReady() const {
  return session_.hasScan() && session_.output().faired && !session_.isBusy() && !session_.isStale(StageId::Faired);
}

const ExportSize& ExportPanel::size() {
  if (sizeOf_ != session_.output().faired) {
    sizeOf_ = session_.output().faired;
    measured_ = exportSize(session_.output());
  }
  return measured_;
}

QString ExportPanel::reasonToWait() const {
  if (!session_.hasScan()) return tr("Open a scan first.");
  if (session_.isBusy()) return tr("Still computing.");
  if (session_.isStale(StageId::Faired) || !session_.output().faired) {
    if (session_.isStopped()) return tr("The computation was stopped: compute again to export.");
    if (session_.output().error) return QString::fromStdString(session_.output().error->message);
  }
  return {};
}

void ExportPanel::refresh() {
  again_->setVisible(!session_.isWorking() && session_.isStopped() && session_.isStale(StageId::Faired));
  // Measured and looked for on the disk only while someone reads it.
  if (!isVisible()) return;
  const ExportSize size = session_.hasScan() ? this->size() : ExportSize{};
  export_->setEnabled(isReady() && size.curves > 0 && !path_->text().trimmed().isEmpty());
  const bool exists = QFileInfo::exists(path_->text()) && path_->text() != lastWritten_ && confirmReplace_;
  export_->setText(running_ ? tr("Writing…") : exists ? tr("Replace the file") : tr("Export"));
  if (const QString reason = reasonToWait(); !reason.isEmpty()) return size_->setText(reason);
  if (size.curves == 0) return size_->setText(tr("There is no curve to export yet."));
  QString text = tr("Will import as %1 × %2 mm").arg(size.widthMm, 0, 'f', 1).arg(size.heightMm, 0, 'f', 1);
  text += QStringLiteral(", ") + counted(size.curves, tr("1 curve."), tr("%1 curves."));
  if (isScaleAssumed(*session_.scan(), session_.recipe()))
    text += tr(" The scale is not known: set the resolution in the Scan stage.");
  size_->setText(text);
}

void ExportPanel::start() {
  if (!isReady() || running_) return;
  const QString path = withSuffix(QFileInfo(path_->text().trimmed()).absoluteFilePath(), suffix());
  if (path != path_->text()) {
    path_->setText(path);
    path_->setModified(true);
  }
  if (QFileInfo::exists(path) && path != lastWritten_ && !confirmReplace_) {
    confirmReplace_ = true;
    result_->setText(tr("%1 exists. Press again to replace it.").arg(QFileInfo(path).fileName()));
    return refresh();
  }
  ExportRequest request{session_.output(),   session_.recipe(),
                        session_.scan(),     static_cast<ExportFormat>(format_->current()),
                        tolerance_->value(), std::filesystem::path(path.toStdU16String())};
  running_ = true;
  writing_ = session_.recipe();
  if (path_->isModified()) QSettings().setValue(kFolderKey, QFileInfo(path).absolutePath());
  result_->clear();
  refresh();
  worker_->start(
      [request = std::move(request), panel = QPointer<ExportPanel>(this)](const CancelToken&) {
        const auto outcome = runExport(request);
        if (!panel) return;
        QMetaObject::invokeMethod(
            panel.data(),
            [panel, outcome] {
              if (panel) panel->finish(outcome);
            },
            Qt::QueuedConnection);
      },
      BackgroundWorker::Running::Finish);
}

void ExportPanel::finish(const Result<ExportOutcome>& outcome) {
  running_ = false;
  confirmReplace_ = false;
  if (!outcome) {
    refresh();
    emit failed(outcome.error());
    return;
  }
  lastWritten_ = QString::fromStdU16String(outcome->path.u16string());
  const QString name = QFileInfo(lastWritten_).fileName();
  QString curves = counted(outcome->curves, tr("1 curve"), tr("%1 curves"));
  if (outcome->lines != outcome->curves)
    curves += QLatin1Char(' ') + counted(outcome->lines, tr("in 1 line"), tr("in %1 lines"));
  const QString largest = QString::number(outcome->largestDifferenceMm, 'g', 2);
  if (outcome->cubics > 0)
    result_->setText(tr("Wrote %1 to %2 as %3 cubics, largest difference from the exact curves %4 mm.")
                         .arg(curves, name, grouped(outcome->cubics), largest));
  else
    result_->setText(tr("Wrote %1 to %2, read back, largest difference %3 mm.").arg(curves, name, largest));
  refresh();
  // A change made meanwhile is not in the file.
  emit exported(writing_ == session_.recipe());
}

}  // namespace batten
