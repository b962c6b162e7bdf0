// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/files/path_text.h"

#include <QByteArray>
#include <QUrl>
#include <algorithm>
#include <string>
#include <system_error>
#include <type_traits>

#include "core/base/shown_text.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

constexpr char16_t kFirstByte = 0xDC00;  ///< Code unit of a byte that is no UTF-8: this and the byte.
// Bytes below 0x80 are always UTF-8.
constexpr char16_t kLowestByte = kFirstByte + 0x80, kHighestByte = kFirstByte + 0xFF;
constexpr qsizetype kLongestCharacter = 4;  ///< [bytes]
const QString kAddress = QStringLiteral("file://");

/// True where a code unit stands for a byte: half of a pair does not.
bool isByteAt(const QString& text, qsizetype i) {
  const char16_t unit = text[i].unicode();
  return unit >= kLowestByte && unit <= kHighestByte && !(i > 0 && text[i - 1].isHighSurrogate());
}

QString textOfBytes(const QByteArray& bytes) {
  if (QUtf8StringView(bytes).isValidUtf8()) return QString::fromUtf8(bytes);
  QString text;
  for (qsizetype i = 0; i < bytes.size();) {
    qsizetype length = 1;
    while (length <= kLongestCharacter && i + length <= bytes.size() &&
           !QUtf8StringView(bytes.constData() + i, length).isValidUtf8())
      ++length;
    if (length <= kLongestCharacter && i + length <= bytes.size()) {
      text += QString::fromUtf8(bytes.constData() + i, length);
      i += length;
    } else {
      text += QChar(static_cast<char16_t>(kFirstByte + static_cast<unsigned char>(bytes[i])));
      ++i;
    }
  }
  return text;
}

QByteArray bytesOfText(const QString& text) {
  if (isUnicodePath(text)) return text.toUtf8();
  QByteArray bytes;
  qsizetype begin = 0;
  for (qsizetype i = 0; i < text.size(); ++i) {
    if (!isByteAt(text, i)) continue;
    bytes += QStringView(text).mid(begin, i - begin).toUtf8();
    bytes += static_cast<char>(text[i].unicode() - kFirstByte);
    begin = i + 1;
  }
  return bytes + QStringView(text).mid(begin).toUtf8();
}

/// As Qt's dialogs show a name.
QString lossyText(const fs::path& name) {
  if constexpr (std::is_same_v<fs::path::value_type, char>)
    return QString::fromUtf8(QByteArray::fromStdString(name.native()));
  else
    return pathText(name);
}

/// The entry of a folder that looks like `shown`; empty if there is none, or more than one.
fs::path entryShownAs(const fs::path& folder, const QString& shown) {
  fs::path found;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (lossyText(entry->path().filename()) != shown) continue;
    if (!found.empty()) return {};
    found = entry->path();
  }
  return found;
}

}  // namespace

QString pathText(const fs::path& path) {
  if constexpr (std::is_same_v<fs::path::value_type, char>)
    return textOfBytes(QByteArray::fromStdString(path.native()));
  else
    return QString::fromStdU16String(path.u16string());
}

fs::path nativePath(const QString& text) {
  if constexpr (std::is_same_v<fs::path::value_type, char>)
    return fs::path(bytesOfText(text).toStdString());
  else
    return fs::path(text.toStdU16String());
}

QString pathText(const QUrl& url) {
  if (!url.isLocalFile()) return {};
  const QByteArray bytes = QByteArray::fromPercentEncoding(url.path(QUrl::FullyEncoded).toLatin1());
  return QUtf8StringView(bytes).isValidUtf8() ? url.toLocalFile() : textOfBytes(bytes);
}

QString chosenPath(const QString& fromDialog) {
  const bool isLossy = fromDialog.contains(QChar(QChar::ReplacementCharacter));
  if (!isLossy || pathExists(fromDialog)) return fromDialog;
  fs::path exact;
  for (const fs::path& part : nativePath(fromDialog)) {
    std::error_code failed;
    const fs::path plain = exact / part;
    const QString shown = pathText(part);
    const bool mayBeAnother = shown.contains(QChar(QChar::ReplacementCharacter)) && !fs::exists(plain, failed);
    const fs::path other = mayBeAnother ? entryShownAs(exact, shown) : fs::path();
    exact = other.empty() ? plain : other;
  }
  return pathText(exact);
}

bool isUnicodePath(const QString& text) {
  for (qsizetype i = 0; i < text.size(); ++i)
    if (isByteAt(text, i)) return false;
  return true;
}

bool pathExists(const QString& text) {
  std::error_code failed;
  return !text.isEmpty() && fs::exists(nativePath(text), failed) && !failed;
}

QString absolutePath(const QString& text) {
  if (text.isEmpty()) return {};
  std::error_code failed;
  const fs::path absolute = fs::absolute(nativePath(text), failed);
  return failed ? text : pathText(absolute.lexically_normal());
}

QString folderOf(const QString& text) { return pathText(nativePath(absolutePath(text)).parent_path()); }

QString shownFileName(const QString& text) { return QString::fromStdString(shownName(nativePath(text).filename())); }

QString shownPath(const QString& text) { return QString::fromStdString(shownName(nativePath(text))); }

QString proposedFileName(const QString& text) {
  QString name = pathText(nativePath(text).filename());
  for (qsizetype i = 0; i < name.size(); ++i)
    if (isByteAt(name, i)) name[i] = QLatin1Char('_');
  return name;
}

QString storedPath(const QString& text) {
  if (isUnicodePath(text)) return text;
  return kAddress + QString::fromLatin1(bytesOfText(text).toPercentEncoding("/"));
}

QString pathFromStored(const QString& stored) {
  if (!stored.startsWith(kAddress)) return stored;
  return textOfBytes(QByteArray::fromPercentEncoding(stored.mid(kAddress.size()).toLatin1()));
}

}  // namespace batten
