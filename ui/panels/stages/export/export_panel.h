// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "ui/panels/stages/export/export_folder.h"
#include "ui/panels/stages/export/export_job.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QStackedWidget;

namespace batten {

class BackgroundWorker;
class ExportChoice;
class ExportOptions;
class ExportPreview;
class LinesNote;
class ReportSection;
class SvgCarrier;

/// Format, place and size of what is written; writing runs in the background and is read back.
class ExportPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ExportPanel(EditorSession& session, QWidget* parent = nullptr);
  ~ExportPanel() override;
  /// Asks for the file to write.
  void browse();
  /// Puts the curves on the clipboard as SVG.
  void copy();

 signals:
  void exported(bool presentResult);  ///< True after a file holds the present result, false once that changes.
  void failed(const batten::Error& error);
  void said(const QString& sentence);  ///< What was done beside an export.

 protected:
  void showEvent(QShowEvent*) override;

 private:
  void buildForm();
  void refresh();
  void suggestName();
  void openedAnother();
  QString wantedPath() const;
  /// Whether a file stands there that this window did not write, or that was changed since.
  bool isOfOthers(const QString& path) const;
  QString reasonToWait() const;
  void start();
  void finish(const Result<ExportReport>& report);
  bool isReady() const;
  const ExportSize& size();
  ExportRequest request(const QString& path) const;
  void refreshPreview();
  void dragOut(std::optional<int> number);
  QString summary(const ExportSize& size) const;

  EditorSession& session_;
  ExportOptions* options_;
  ExportChoice* choice_;
  ExportPreview* preview_;
  LinesNote* held_;
  QPushButton* turn_;
  SvgCarrier* carrier_;
  ReportSection* report_;
  QProgressBar* progress_;
  CancelToken cancel_;
  QLineEdit* path_;
  QPushButton* browse_;
  LinesNote* size_;
  QPushButton* export_;
  QPushButton* again_;
  LinesNote* result_;
  QStackedWidget* status_;  ///< The result, the progress, or how to go on.
  /// What the preview was made of.
  struct Previewed {
    std::shared_ptr<const FairedSet> faired;
    std::vector<DirectionMark> directions;
    std::vector<StartMark> starts;
    ExportedCurves which = ExportedCurves::Faired;
    std::optional<std::set<int>> numbers;
    bool isJoined = false;
    double scale = 1.0;
    bool operator==(const Previewed&) const = default;
  };
  std::optional<Previewed> previewed_;
  bool confirmReplace_ = false;
  bool running_ = false;
  std::optional<FileState> lastWritten_;     ///< Right after this window wrote it.
  std::shared_ptr<const FairedSet> sizeOf_;  ///< What size_ was measured of: only when it changes, and is seen.
  ExportedCurves sizeWhich_ = ExportedCurves::Faired;
  std::optional<std::set<int>> sizeNumbers_;
  ExportSize measured_;
  Recipe writing_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
};

}  // namespace batten
