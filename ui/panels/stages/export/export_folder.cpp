// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export/export_folder.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <system_error>

#include "ui/panels/controls/save_dialog.h"
#include "ui/session/editor_session.h"
#include "ui/session/files/path_text.h"

namespace batten {
namespace {

const QString kExportFolderKey = QStringLiteral("export/folder");

/// That of the scan, of the first imported file or, for an empty page, "drawing".
QString drawingName(const EditorSession& session) {
  if (!session.isBlankPage()) return QFileInfo(proposedFileName(session.scanPath())).completeBaseName();
  const auto& imports = session.recipe().imports;
  const QString source = imports.empty() ? QString() : QString::fromStdString(imports.front().source);
  const QString name = QFileInfo(source).completeBaseName();
  return name.isEmpty() ? QStringLiteral("drawing") : name;
}

}  // namespace

QString proposedExportPath(const EditorSession& session, const QString& ending) {
  const QString scan = session.scanPath();
  QString folder = pathFromStored(QSettings().value(kExportFolderKey).toString());
  if (folder.isEmpty() && !session.isBlankPage() && !isOfProgram(scan)) folder = folderOf(scan);
  if (!isPlaceToSave(folder)) folder = QDir::homePath();
  return folder + QLatin1Char('/') + drawingName(session) + ending;
}

void rememberExportFolder(const QString& path) { QSettings().setValue(kExportFolderKey, storedPath(folderOf(path))); }

std::optional<FileState> stateOfFile(const QString& path) {
  const std::filesystem::path file = nativePath(path);
  std::error_code failed, unknown;  // a folder has no size
  if (!std::filesystem::exists(file, failed)) return std::nullopt;
  return FileState{path, std::filesystem::file_size(file, unknown), std::filesystem::last_write_time(file, unknown)};
}

}  // namespace batten
