// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/recipe_journal.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QUuid>
#include <filesystem>
#include <string>

#include "core/exchange/save_atomically.h"
#include "core/pipeline/recipe/recipe_file.h"

namespace batten {
namespace {

constexpr qint64 kLargestBytes = 64 << 20;

std::unique_ptr<QLockFile> lockOf(const QString& file) {
  auto lock = std::make_unique<QLockFile>(file + QStringLiteral(".lock"));
  lock->setStaleLockTime(0);  // However long it runs: only a program that has gone gives its file up.
  return lock;
}

std::optional<RecipeJournal::Left> readJournal(const QString& path) {
  QFile file(path);
  if (file.size() > kLargestBytes || !file.open(QIODevice::ReadOnly)) return std::nullopt;
  const QJsonObject object = QJsonDocument::fromJson(file.readAll()).object();
  auto recipe = recipeFromJson(object[QStringLiteral("recipe")].toString().toStdString());
  const QString scan = object[QStringLiteral("scan")].toString();
  if (!recipe || (scan.isEmpty() && !recipe->page)) return std::nullopt;
  return RecipeJournal::Left{path, scan, QFileInfo(path).lastModified(), std::move(*recipe)};
}

}  // namespace

RecipeJournal::RecipeJournal(EditorSession& session, const QString& folder)
    : session_(session), folder_(folder), worker_(std::make_unique<BackgroundWorker>()) {
  file_ = QDir(folder).filePath(QUuid::createUuid().toString(QUuid::WithoutBraces) + QStringLiteral(".journal"));
  timer_.setInterval(kIntervalMs);
  connect(&timer_, &QTimer::timeout, this, &RecipeJournal::write);
  connect(session.undoStack(), &QUndoStack::cleanChanged, this, [this](bool clean) { clean ? forget() : write(); });
  timer_.start();
}

RecipeJournal::~RecipeJournal() {
  worker_.reset();  // What it still writes comes first.
  QFile::remove(file_);
}

void RecipeJournal::write() {
  if (!session_.hasUnsavedChanges() || (written_ && *written_ == session_.recipe())) return;
  written_ = session_.recipe();
  if (!lock_) {
    QDir().mkpath(folder_);
    lock_ = lockOf(file_);
    lock_->tryLock(0);
  }
  worker_->start(
      [recipe = *written_, scan = session_.scanPath(), file = file_](const CancelToken&) {
        QJsonObject object;
        object[QStringLiteral("scan")] = scan;
        object[QStringLiteral("recipe")] = QString::fromStdString(recipeToJson(recipe));
        const QByteArray bytes = QJsonDocument(object).toJson(QJsonDocument::Compact);
        // Should it fail there is nothing to tell: the drawing is where it was.
        (void)saveAtomically(std::filesystem::path(file.toStdU16String()),
                             std::string_view(bytes.constData(), static_cast<std::size_t>(bytes.size())));
      },
      BackgroundWorker::Running::Finish);
}

void RecipeJournal::forget() {
  written_.reset();
  worker_->start([file = file_](const CancelToken&) { QFile::remove(file); }, BackgroundWorker::Running::Finish);
}

std::optional<RecipeJournal::Left> RecipeJournal::left() {
  const QFileInfoList files =
      QDir(folder_).entryInfoList({QStringLiteral("*.journal")}, QDir::Files, QDir::Time);  // newest first
  for (const QFileInfo& info : files) {
    const QString path = info.absoluteFilePath();
    if (path == QFileInfo(file_).absoluteFilePath()) continue;
    auto lock = lockOf(path);
    if (!lock->tryLock(0)) continue;
    if (auto left = readJournal(path)) {
      leftLock_ = std::move(lock);
      return left;
    }
  }
  return std::nullopt;
}

void RecipeJournal::takeOver(const Left& left) {
  if (file_ != left.file) forget();
  file_ = left.file;
  lock_ = std::move(leftLock_);
  written_.reset();
}

void RecipeJournal::discard(const Left& left) {
  QFile::remove(left.file);
  leftLock_.reset();
}

}  // namespace batten
