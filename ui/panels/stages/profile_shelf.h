// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>

#include "ui/session/editor_session.h"

namespace batten {

/// The profiles that the user has saved, each to be dragged onto a line of the drawing, which then follows it; a double
/// click or Enter gives it to the selected curve, Del removes it from the library.
class ProfileShelf : public QListWidget {
  Q_OBJECT
 public:
  explicit ProfileShelf(EditorSession& session, QWidget* parent = nullptr);
  /// Reads the library again.
  void refresh();
  /// Removes the current profile, after a question.
  void removeCurrent();

 signals:
  void emptied();  ///< The last profile was removed.

 protected:
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override;
  void showEvent(QShowEvent*) override;

 private:
  EditorSession& session_;
};

}  // namespace batten
