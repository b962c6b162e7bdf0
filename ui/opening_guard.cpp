// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/opening_guard.h"

#include <QCoreApplication>
#include <QSettings>

#include "core/base/platform.h"
#include "ui/session/editor_session.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {

const QString kPathKey = QStringLiteral("opening/path"), kProgramKey = QStringLiteral("opening/program");

QString ownMark() { return QString::fromStdString(processMark(QCoreApplication::applicationPid())); }

/// Whether the program of this mark runs and is another than this one.
bool isOther(const QString& mark) {
  const std::string running = processMark(mark.section(QLatin1Char(' '), 0, 0).toLongLong());
  return !mark.isEmpty() && QString::fromStdString(running) == mark && mark != ownMark();
}

}  // namespace

OpeningGuard::OpeningGuard(EditorSession& session, QObject* parent) : QObject(parent) {
  connect(&session, &EditorSession::runFinished, this, [this, &session] {
    // Also when it was opened by hand in the end: it does no harm now.
    if (hasFailed(session.scanPath())) path_ = session.scanPath();
    end();
  });
  connect(&session, &EditorSession::failed, this, [this] { end(); });
}

OpeningGuard::~OpeningGuard() { end(); }

void OpeningGuard::begin(const QString& path) {
  path_ = path;
  QSettings settings;
  settings.setValue(kPathKey, storedPath(path));
  settings.setValue(kProgramKey, ownMark());
  settings.sync();  // Now: there may be no later.
}

bool OpeningGuard::hasFailed(const QString& path) {
  const QSettings settings;
  return !path.isEmpty() && settings.value(kPathKey).toString() == storedPath(path) &&
         !isOther(settings.value(kProgramKey).toString());
}

void OpeningGuard::end() {
  if (path_.isEmpty()) return;
  path_.clear();
  QSettings settings;
  settings.remove(QStringLiteral("opening"));
  settings.sync();
}

}  // namespace batten
