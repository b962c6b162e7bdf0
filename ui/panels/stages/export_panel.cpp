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
#include <filesystem>

#include "core/pipeline/run/pipeline.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/controls/path_edit.h"
#include "ui/panels/controls/save_dialog.h"
#include "ui/panels/stages/export_options.h"
#include "ui/session/background_worker.h"
#include "ui/session/path_text.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

const QString kFolderKey = QStringLiteral("export/folder");

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
      path_(new PathEdit(this)),
      browse_(plainButton(tr("Choose…"), QStringLiteral("export.browse"), this)),
      size_(note({}, this)),
      export_(plainButton(tr("Export"), QStringLiteral("export.run"), this)),
      again_(linkButton(tr("Compute again"), QStringLiteral("export.again"), this)),
      result_(note({}, this)),
      worker_(std::make_unique<BackgroundWorker>()) {
  buildForm();
  connect(options_, &ExportOptions::formatChanged, this, [this] {
    confirmReplace_ = false;
    suggestName();
  });
  connect(options_, &ExportOptions::changed, this, &ExportPanel::refresh);
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
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(14, 12, 14, 12);
  layout->setSpacing(8);
  layout->addWidget(heading(tr("Export"), this));
  layout->addWidget(options_);
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
  const QString suffix = options_->suffix();
  if (!path_->text().isEmpty() && path_->isModified()) {
    const QFileInfo now(path_->text());
    path_->setText(now.path() + QLatin1Char('/') + withoutEnding(now.fileName()) + QLatin1Char('.') + suffix);
    path_->setModified(true);
  } else if (session_.hasScan()) {
    const QString scan = session_.scanPath();
    QString folder = QSettings().value(kFolderKey).toString();
    if (folder.isEmpty() && !session_.isBlankPage() && !isOfProgram(scan)) folder = folderOf(scan);
    if (folder.isEmpty() || !isUnicodePath(folder) || !QFileInfo(folder).isWritable()) folder = QDir::homePath();
    const QString name =
        session_.isBlankPage() ? QStringLiteral("drawing") : QFileInfo(proposedFileName(scan)).completeBaseName();
    path_->setText(folder + QLatin1Char('/') + name + QLatin1Char('.') + suffix);
    path_->setCursorPosition(static_cast<int>(path_->text().size()));
  }
  path_->setToolTip(path_->text());
  refresh();
}

void ExportPanel::browse() {
  const QString chosen = askSavePath(this, {tr("Export"), path_->text(), options_->filter(), options_->suffix()});
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
  if (sizeOf_ != session_.output().faired || sizeWhich_ != options_->which()) {
    sizeOf_ = session_.output().faired;
    sizeWhich_ = options_->which();
    measured_ = exportSize(session_.output(), sizeWhich_);
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
  again_->setVisible(!session_.isWorking() && session_.isStopped() && session_.isStale(StageId::Faired));
  // Measured and looked for on the disk only while someone reads it.
  if (!isVisible()) return;
  const ExportSize size = session_.hasScan() ? this->size() : ExportSize{};
  export_->setEnabled(isReady() && options_->obstacle().isEmpty() && size.curves > 0 &&
                      !path_->text().trimmed().isEmpty());
  const bool exists = QFileInfo::exists(path_->text()) && path_->text() != lastWritten_ && confirmReplace_;
  export_->setText(running_ ? tr("Writing…") : exists ? tr("Replace the file") : tr("Export"));
  if (const QString reason = reasonToWait(); !reason.isEmpty()) return size_->setText(reason);
  if (size.curves == 0) return size_->setText(tr("There is no curve to export yet."));
  const ExportSettings settings = options_->settings();
  const double width = size.widthMm * settings.scale, height = size.heightMm * settings.scale;
  QString text = tr("Will import as %1 × %2 mm").arg(width, 0, 'f', 1).arg(height, 0, 'f', 1);
  if (settings.unit == LengthUnit::Inch) {
    const double inch = millimetresPer(LengthUnit::Inch);
    text += tr(" (%1 × %2 in)").arg(width / inch, 0, 'f', 3).arg(height / inch, 0, 'f', 3);
  }
  text += QStringLiteral(", ") + counted(size.curves, tr("1 curve."), tr("%1 curves."));
  if (isScaleAssumed(*session_.scan(), session_.recipe()))
    text += tr(" The scale is not known: set the resolution in the Scan stage.");
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

void ExportPanel::start() {
  if (!isReady() || running_) return;
  const QString path = wantedPath();
  if (path != path_->text()) {
    path_->setText(path);
    path_->setModified(true);
  }
  if (QFileInfo::exists(path) && path != lastWritten_ && !confirmReplace_) {
    confirmReplace_ = true;
    result_->setText(tr("%1 exists. Press again to replace it.").arg(QFileInfo(path).fileName()));
    return refresh();
  }
  ExportRequest request{session_.output(),    session_.recipe(), session_.scan(),
                        options_->settings(), options_->which(), nativePath(path)};
  running_ = true;
  writing_ = session_.recipe();
  if (path_->isModified()) QSettings().setValue(kFolderKey, QFileInfo(path).absolutePath());
  result_->clear();
  refresh();
  worker_->start(
      [request = std::move(request), panel = QPointer<ExportPanel>(this)](const CancelToken& cancel) {
        RunContext context;
        context.cancel = cancel;
        const auto outcome = runExport(request, context);
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

void ExportPanel::finish(const Result<ExportReport>& report) {
  running_ = false;
  confirmReplace_ = false;
  if (!report) {
    refresh();
    emit failed(report.error());
    return;
  }
  lastWritten_ = pathText(report->path);
  result_->setText(
      tr("Wrote %1: %2.").arg(QFileInfo(lastWritten_).fileName(), QString::fromStdString(sentenceOf(*report))));
  refresh();
  // A change made meanwhile is not in the file.
  emit exported(writing_ == session_.recipe());
}

}  // namespace batten
