// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

namespace batten {

class EditorSession;

/// Where to write a file of the present drawing: in the folder that was chosen last, else beside the scan, else in the
/// home folder; named after the scan or the imported file. The path is Unicode and its folder can be written to.
/// @param ending with its dots, as ".svg" or ".report.pdf"
QString proposedExportPath(const EditorSession&, const QString& ending);

/// Keeps the folder of a path that the user chose, for later proposals.
void rememberExportFolder(const QString& path);

}  // namespace batten
