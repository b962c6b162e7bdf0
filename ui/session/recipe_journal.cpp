// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/recipe_journal.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QUuid>
#include <filesystem>
#include <string>
#include <utility>

#include "core/base/platform.h"
#include "core/base/regular_file.h"
#include "core/document/unsaved_work.h"
#include "core/exchange/save_atomically.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {

constexpr std::uint64_t kLargestBytes = std::uint64_t{64} << 20;  // limit of input

std::unique_ptr<LockFile> lockOf(const QString& journal) {
  return std::make_unique<LockFile>(nativePath(journal + QStringLiteral(".lock")));
}

std::optional<RecipeJournal::Left> readJournal(const QString& path) {
  const auto text = readWhole(nativePath(path), kLargestBytes);
  if (!text) return std::nullopt;
  auto work = unsavedWorkFromJson(*text);
  if (!work) return std::nullopt;
  return RecipeJournal::Left{path, pathFromStored(QString::fromStdString(work->scanPath)),
                             QFileInfo(path).lastModified(), std::move(work->recipe)};
}

}  // namespace

RecipeJournal::RecipeJournal(EditorSession& session, const QString& folder)
    : session_(session), folder_(folder), file_(newFile()), worker_(std::make_unique<BackgroundWorker>()) {
  timer_.setInterval(kIntervalMs);
  connect(&timer_, &QTimer::timeout, this, &RecipeJournal::write);
  connect(session.undoStack(), &QUndoStack::cleanChanged, this, [this](bool clean) { clean ? forget() : write(); });
  timer_.start();
}

RecipeJournal::~RecipeJournal() {
  worker_.reset();  // What it still writes comes first.
  if (lock_ && lock_->hold()) QFile::remove(file_);
}

QString RecipeJournal::newFile() const {
  return QDir(folder_).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces) + QStringLiteral(".journal"));
}

void RecipeJournal::write() {
  const bool isHeld = lock_ && lock_->hold();
  // What was undone in part may be what is saved.
  if (!session_.hasUnsavedChanges()) return written_ || isFailing_ ? forget() : void();
  if (isHeld && written_ && *written_ == session_.recipeToSave() && QFile::exists(file_)) return;
  if (!isHeld) {
    // The file may be somebody else's by now, or is not there yet.
    QDir().mkpath(folder_);
    if (lock_) file_ = newFile();
    lock_ = lockOf(file_);
    written_.reset();
    ++generation_;
    // A folder that takes no lock takes no journal: the next tick tries again.
    if (const LockState state = lock_->tryHold(); state != LockState::Held)
      return setFailing(isFailing_ || state == LockState::Impossible);
  }
  worker_->start(
      [this, generation = generation_, recipe = session_.recipeToSave(), scan = storedPath(session_.scanPath()),
       file = file_](const CancelToken&) {
        const std::string bytes = unsavedWorkToJson({scan.toStdString(), recipe});
        auto saved = saveAndHold(nativePath(file), bytes);
        if (!saved) {  // The drawing is where it was, and the next tick tries again.
          return inbox_.post([this, generation] {
            if (generation == generation_) setFailing(true);
          });
        }
        inbox_.post([this, generation, recipe, held = std::shared_ptr<SystemFile>(std::move(*saved))] {
          written(generation, recipe, held);
        });
      },
      BackgroundWorker::Running::Finish);
}

void RecipeJournal::written(int generation, const Recipe& recipe, std::shared_ptr<SystemFile> held) {
  if (generation != generation_) return;
  setFailing(false);
  written_ = recipe;
  held_ = std::move(held);  // now only the one before may go: there is always one that is held
}

void RecipeJournal::setFailing(bool isFailing) {
  if (std::exchange(isFailing_, isFailing) != isFailing) emit failingChanged(isFailing);
}

void RecipeJournal::forget() {
  setFailing(false);  // Nothing is left that would have to be written.
  written_.reset();
  ++generation_;
  if (!lock_ || !lock_->hold()) return;  // Nothing was written, or it is no longer this session's.
  worker_->start(
      [file = file_, held = std::exchange(held_, nullptr)](const CancelToken&) mutable {
        held.reset();  // a file that is open does not go everywhere
        QFile::remove(file);
      },
      BackgroundWorker::Running::Finish);
}

/// A program that is killed before it has written its journal leaves the lock alone.
void RecipeJournal::removeLeftLocks() {
  const QString ending = QStringLiteral(".lock");
  for (const QFileInfo& info : QDir(folder_).entryInfoList({QStringLiteral("*.journal") + ending}, QDir::Files)) {
    const QString path = info.absoluteFilePath();
    const QString journal = path.chopped(ending.size());
    // Held by nobody: then it goes with this one. A program that was about to take it takes another at its next tick.
    if (!QFile::exists(journal)) lockOf(journal)->hold();
  }
}

std::optional<RecipeJournal::Left> RecipeJournal::left() {
  removeLeftLocks();
  const QFileInfoList files =
      QDir(folder_).entryInfoList({QStringLiteral("*.journal")}, QDir::Files, QDir::Time);  // newest first
  for (const QFileInfo& info : files) {
    const QString path = info.absoluteFilePath();
    if (path == QFileInfo(file_).absoluteFilePath()) continue;
    // The work of a window that runs is not even asked for its lock, which the window may be about to renew.
    std::shared_ptr<SystemFile> held = takeAlone(nativePath(path));
    if (!held) continue;
    auto lock = lockOf(path);
    if (!lock->hold()) continue;
    if (auto left = readJournal(path)) {
      leftLock_ = std::move(lock);
      leftHeld_ = std::move(held);
      return left;
    }
  }
  return std::nullopt;
}

void RecipeJournal::takeOver(const Left& left) {
  if (!leftLock_ || !leftLock_->hold()) return;  // Another window was faster: this one keeps a file of its own.
  if (file_ != left.file) forget();
  file_ = left.file;
  lock_ = std::move(leftLock_);
  held_ = std::move(leftHeld_);
  written_.reset();
  ++generation_;
}

void RecipeJournal::discard(const Left& left) {
  if (leftLock_ && leftLock_->hold()) QFile::remove(left.file);
  leftLock_.reset();
  leftHeld_.reset();
}

}  // namespace batten
