// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/save_dialog.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>

#include "core/base/platform.h"
#include "ui/panels/controls/save_here_dialog.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {

/// @pre the path proposed is Unicode
QString askByFileDialog(QWidget* parent, const SaveQuestion& question) {
  const QFileInfo start(question.start);
  QFileDialog dialog(parent, question.title, start.absolutePath(), question.filter);
  dialog.setObjectName(QStringLiteral("saveDialog"));
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setFileMode(QFileDialog::AnyFile);
  dialog.setDefaultSuffix(question.suffix);
  dialog.selectFile(start.fileName());
  if (dialog.exec() != QDialog::Accepted) return {};
  // Some desktops' own dialogs leave the suffix to the program.
  return withSuffix(chosenPath(dialog.selectedFiles().value(0)), question.suffix);
}

}  // namespace

QString askSavePath(QWidget* parent, const SaveQuestion& question) {
  if (isUnicodePath(question.start)) return askByFileDialog(parent, question);
  SaveHereDialog here(question, parent);
  switch (here.exec()) {
    case QDialog::Accepted:
      return here.path();
    case SaveHereDialog::kElsewhere: {
      SaveQuestion elsewhere = question;
      const QString folder = folderOf(question.start);
      elsewhere.start =
          (isUnicodePath(folder) ? folder : QDir::homePath()) + QLatin1Char('/') + proposedFileName(question.start);
      return askByFileDialog(parent, elsewhere);
    }
    default:
      return {};
  }
}

bool isPlaceToSave(const QString& folder) { return !folder.isEmpty() && isWritableFolder(nativePath(folder)); }

bool isOfProgram(const QString& path) {
  const QString own =
      QFileInfo(QCoreApplication::applicationDirPath() + QStringLiteral("/../share/batten")).canonicalFilePath();
  return !own.isEmpty() && isUnicodePath(path) &&
         QFileInfo(path).canonicalFilePath().startsWith(own + QLatin1Char('/'));
}

QString withSuffix(const QString& path, const QString& suffix) {
  if (path.isEmpty() || !QFileInfo(path).suffix().isEmpty()) return path;
  return path + (path.endsWith(QLatin1Char('.')) ? QString() : QStringLiteral(".")) + suffix;
}

}  // namespace batten
