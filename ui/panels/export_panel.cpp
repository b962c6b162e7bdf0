// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/export_panel.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/pipeline/pipeline.h"
#include "ui/panels/number_field.h"
#include "ui/panels/panel_parts.h"
#include "ui/panels/segmented_control.h"
#include "ui/session/background_worker.h"
#include "ui/theme/theme.h"

namespace batten {

ExportPanel::ExportPanel(EditorSession& session, QWidget* parent)
    : QWidget(parent),
      session_(session),
      format_(new SegmentedControl({tr("SVG"), tr("Curve JSON")}, this)),
      path_(new QLineEdit(this)),
      browse_(plainButton(tr("Choose…"), QStringLiteral("export.browse"), this)),
      toleranceLabel_(new QLabel(tr("Accuracy of the cubics"), this)),
      tolerance_(new NumberField(this)),
      formatNote_(note({}, this)),
      size_(note({}, this)),
      export_(plainButton(tr("Export"), QStringLiteral("export.run"), this)),
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
  connect(&session_, &EditorSession::scanOpened, this, [this] {
    lastWritten_.clear();
    result_->clear();
    suggestName();
  });
  connect(&session_, &EditorSession::recipeChanged, this, [this] {
    confirmReplace_ = false;
    result_->clear();
    emit exported(false);
    refresh();
  });
  connect(&session_, &EditorSession::runFinished, this, &ExportPanel::refresh);
  connect(&session_, &EditorSession::busyChanged, this, &ExportPanel::refresh);
  setFormat(ExportFormat::Svg);
}

ExportPanel::~ExportPanel() = default;

void ExportPanel::buildForm() {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(14, 12, 14, 12);
  layout->setSpacing(8);
  layout->addWidget(heading(tr("Export"), this));
  format_->setNames(QStringLiteral("export.format"), {QStringLiteral("svg"), QStringLiteral("json")});
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
  file->addWidget(path_, 1);
  file->addWidget(browse_);
  layout->addLayout(file);
  layout->addWidget(size_);
  export_->setProperty("primary", true);
  layout->addWidget(export_);
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
}

void ExportPanel::suggestName() {
  const QString suffix = format_->current() == 0 ? QStringLiteral("svg") : QStringLiteral("json");
  if (!path_->text().isEmpty() && path_->isModified()) {
    const QFileInfo now(path_->text());
    path_->setText(now.path() + QLatin1Char('/') + now.completeBaseName() + QLatin1Char('.') + suffix);
    path_->setModified(true);
  } else if (!session_.scanPath().isEmpty()) {
    const QFileInfo scan(session_.scanPath());
    const bool writable = QFileInfo(scan.absolutePath()).isWritable();
    path_->setText((writable ? scan.absolutePath() : QDir::homePath()) + QLatin1Char('/') + scan.completeBaseName() +
                   QLatin1Char('.') + suffix);
    path_->setCursorPosition(static_cast<int>(path_->text().size()));
  }
  if (path_->text().isEmpty() && session_.isBlankPage())
    path_->setText(QDir::homePath() + QStringLiteral("/drawing.") + suffix);
  path_->setToolTip(path_->text());
  refresh();
}

void ExportPanel::browse() {
  const bool svg = format_->current() == 0;
  const QString chosen = QFileDialog::getSaveFileName(this, tr("Export"), path_->text(),
                                                      svg ? tr("SVG (*.svg)") : tr("Curve JSON (*.json)"));
  if (chosen.isEmpty()) return;
  path_->setText(chosen);
  path_->setModified(true);
  // The dialog has asked about an existing file already.
  confirmReplace_ = true;
  refresh();
}

bool ExportPanel::isReady() const {
  return session_.hasScan() && session_.output().faired && !session_.isBusy() && !session_.isStale(StageId::Faired) &&
         !running_;
}

void ExportPanel::refresh() {
  const ExportSize size = session_.hasScan() ? exportSize(session_.output()) : ExportSize{};
  export_->setEnabled(isReady() && size.curves > 0 && !path_->text().trimmed().isEmpty());
  const bool exists = QFileInfo::exists(path_->text()) && path_->text() != lastWritten_ && confirmReplace_;
  export_->setText(running_ ? tr("Writing…") : exists ? tr("Replace the file") : tr("Export"));
  if (!session_.hasScan()) return size_->setText(tr("Open a scan first."));
  if (size.curves == 0)
    return size_->setText(session_.isBusy() ? tr("Still computing.") : tr("There is no curve to export yet."));
  QString text = tr("Will import as %1 × %2 mm").arg(size.widthMm, 0, 'f', 1).arg(size.heightMm, 0, 'f', 1);
  text += QStringLiteral(", ") + counted(size.curves, tr("1 curve."), tr("%1 curves."));
  if (isScaleAssumed(*session_.scan(), session_.recipe()))
    text += tr(" The scale is not known: set the resolution in the Scan stage.");
  size_->setText(text);
}

void ExportPanel::start() {
  if (!isReady()) return;
  const QString path = QFileInfo(path_->text().trimmed()).absoluteFilePath();
  if (QFileInfo::exists(path) && path != lastWritten_ && !confirmReplace_) {
    confirmReplace_ = true;
    result_->setText(tr("%1 exists. Press again to replace it.").arg(QFileInfo(path).fileName()));
    return refresh();
  }
  ExportRequest request{session_.output(),   session_.recipe(),
                        session_.scan(),     static_cast<ExportFormat>(format_->current()),
                        tolerance_->value(), std::filesystem::path(path.toStdU16String())};
  running_ = true;
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
    emit failed(QString::fromStdString(outcome.error().message));
    return;
  }
  lastWritten_ = QString::fromStdU16String(outcome->path.u16string());
  const QString name = QFileInfo(lastWritten_).fileName();
  const QString curves = counted(outcome->curves, tr("1 curve"), tr("%1 curves"));
  const QString largest = QString::number(outcome->largestDifferenceMm, 'g', 2);
  if (outcome->cubics > 0)
    result_->setText(tr("Wrote %1 to %2 as %3 cubics, largest difference from the exact curves %4 mm.")
                         .arg(curves, name, grouped(outcome->cubics), largest));
  else
    result_->setText(tr("Wrote %1 to %2, read back, largest difference %3 mm.").arg(curves, name, largest));
  refresh();
  emit exported(true);
}

}  // namespace batten
