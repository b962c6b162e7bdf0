// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <filesystem>

class QUrl;

namespace batten {

/// File names are bytes, the window's texts are Unicode. A path is kept in a QString without loss: a byte that is not
/// part of UTF-8 stands as one of U+DC80 to U+DCFF, which no name can hold. Qt's own file functions do not know such
/// texts; those below do, for absolute and relative paths alike.
QString pathText(const std::filesystem::path& path);
/// The path that pathText() was given, byte by byte.
std::filesystem::path nativePath(const QString& text);

/// Of a file dropped on the window: its address may hold any bytes. Empty if it names no local file.
QString pathText(const QUrl& url);
/// What a file dialog has handed over: it shows U+FFFD for bytes that are not UTF-8 and forgets them. If such a path
/// is not there, but just one whose name is shown alike, that one is meant.
QString chosenPath(const QString& fromDialog);

/// False for paths that Qt's file dialogs can neither show nor hand over.
bool isUnicodePath(const QString& text);
bool pathExists(const QString& text);
QString absolutePath(const QString& text);
QString folderOf(const QString& text);
/// The last part, as a label shows it: with a question mark for what cannot be shown. Not to be opened.
QString shownFileName(const QString& text);
/// The whole path for a label or a tool tip.
QString shownPath(const QString& text);
/// A file name for a proposal: as shown, with underscores for what cannot be.
QString proposedFileName(const QString& text);

/// For settings and journals, whose texts are UTF-8: the path, or an address (file:///…) where it is not Unicode.
QString storedPath(const QString& text);
QString pathFromStored(const QString& stored);

}  // namespace batten
