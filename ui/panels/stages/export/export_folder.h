// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace batten {

class EditorSession;

/// Where to write a file of the present drawing: in the folder that was chosen last, else beside the scan, else in the
/// home folder; named after the scan or the imported file. Its folder can be written to, and may have any bytes in its
/// name (see path_text.h).
/// @param ending with its dots, as ".svg" or ".report.pdf"
QString proposedExportPath(const EditorSession&, const QString& ending);

/// Keeps the folder of a path that the user chose, for later proposals.
void rememberExportFolder(const QString& path);

/// A file as it was when it was looked at.
struct FileState {
  QString path;
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed;
  bool operator==(const FileState&) const = default;
};
/// nullopt: there is no such file.
std::optional<FileState> stateOfFile(const QString& path);

}  // namespace batten
