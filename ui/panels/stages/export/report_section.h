// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>

#include "core/document/report_pages/report_file.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace batten {

class BackgroundWorker;

/// The report to print or to read in a browser: format, paper, and the button that asks where.
class ReportSection : public QWidget {
  Q_OBJECT
 public:
  explicit ReportSection(EditorSession& session, QWidget* parent = nullptr);
  ~ReportSection() override;
  /// Whether there is something to report on.
  void setReady(bool ready);
  /// Forgets what was written last: it is no longer of the present drawing.
  void clearResult();

 signals:
  void written(const QString& sentence);
  void failed(const batten::Error& error);

 private:
  void choose();
  void write(const QString& path);
  void finish(const Result<void>& outcome, const QString& path);

  EditorSession& session_;
  QComboBox* kind_;
  QPushButton* button_;
  QProgressBar* progress_;
  QLabel* result_;  ///< What became of the last report.
  bool isReady_ = false, isRunning_ = false;
  CancelToken cancel_;
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
};

}  // namespace batten
