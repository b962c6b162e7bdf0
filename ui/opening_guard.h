// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>

namespace batten {

class EditorSession;

/// Remembers across starts which file was being opened when the program ended, so that a file on which it ends is not
/// opened by itself at every start. Writes into the settings before the file is touched, and takes it back once the
/// file has been opened and computed, was refused, or the program ends as it should.
class OpeningGuard : public QObject {
 public:
  explicit OpeningGuard(EditorSession& session, QObject* parent = nullptr);
  ~OpeningGuard() override;
  /// A file is about to be opened without anybody asking for it.
  void begin(const QString& path);
  /// Whether a program that has gone ended while it opened this file.
  static bool hasFailed(const QString& path);
  /// The file has been opened, or refused.
  void end();

 private:
  QString path_;  ///< Empty: nothing is being opened.
};

}  // namespace batten
