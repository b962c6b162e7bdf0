// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <QTimer>
#include <memory>
#include <optional>

#include "ui/session/background/background_worker.h"
#include "ui/session/background/inbox.h"
#include "ui/session/editor_session.h"

namespace batten {

class LockFile;
struct SystemFile;

/// Keeps unsaved work on disk, so that a crash loses at most half a minute of it. A file of its own while the session
/// has unsaved changes, written in the background, gone once they are saved, discarded or the program ends as it
/// should. A write that fails is tried again at the next tick. What a program left that did not end so is offered by
/// left(); two locks keep live work from being taken for that: the open file itself, and before it is there one beside
/// it, renewed at every tick. Belongs to the GUI thread.
class RecipeJournal : public QObject {
  Q_OBJECT
 public:
  /// With the time that writing takes on a busy machine, no more than half a minute.
  static constexpr int kIntervalMs = 24000;

  /// @param folder where the files lie; made when the first is written.
  RecipeJournal(EditorSession& session, const QString& folder);
  ~RecipeJournal() override;

  void setIntervalMs(int ms) { timer_.setInterval(ms); }
  QString file() const { return file_; }

  struct Left {
    QString file;      ///< The journal itself.
    QString scanPath;  ///< Empty: a drawing on an empty page.
    QDateTime when;
    Recipe recipe;
  };
  /// The newest work that a program left which has ended without saving or discarding it; none of programs that run.
  std::optional<Left> left();
  /// Goes on with that file as this session's own, until it is saved.
  void takeOver(const Left&);
  void discard(const Left&);

 signals:
  /// Unsaved work cannot be written; or can be again.
  void failingChanged(bool isFailing);

 private:
  void write();
  void written(int generation, const Recipe& recipe, std::shared_ptr<SystemFile> held);
  void forget();
  void setFailing(bool isFailing);
  void removeLeftLocks();
  QString newFile() const;

  EditorSession& session_;
  QString folder_, file_;
  std::unique_ptr<LockFile> lock_, leftLock_;    ///< Of the journal at X: "X.lock".
  std::shared_ptr<SystemFile> held_, leftHeld_;  ///< The journal, taken alone.
  QTimer timer_{this};
  std::optional<Recipe> written_;  ///< What is on disk, as far as known.
  bool isFailing_ = false;
  int generation_ = 0;  ///< Of the file: what an older write reports is of no use any more.
  Inbox inbox_;
  std::unique_ptr<BackgroundWorker> worker_;
};

}  // namespace batten
