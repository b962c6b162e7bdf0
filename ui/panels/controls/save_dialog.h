// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QWidget;

namespace batten {

/// Where to write.
struct SaveQuestion {
  QString title;
  QString start;   ///< The path proposed, of any bytes: see path_text.h.
  QString filter;  ///< "SVG (*.svg)"
  QString suffix;  ///< "svg": what a name without a suffix gets.
};

/// Asks for a file to write; empty = cancelled. The suffix is added before the question about an existing file, so that
/// what is replaced is what was asked about. Where Qt's file dialog cannot name the path proposed, its folder is
/// offered by a dialog of the program's own, which leads on to Qt's.
QString askSavePath(QWidget* parent, const SaveQuestion&);

/// A folder, of any bytes, in which files may be made.
bool isPlaceToSave(const QString& folder);

/// True for what came with the program, as its sample: no place to save anything beside.
bool isOfProgram(const QString& path);

/// A typed path by the same rule.
QString withSuffix(const QString& path, const QString& suffix);

}  // namespace batten
