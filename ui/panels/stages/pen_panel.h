// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QListWidget;
class QPushButton;

namespace batten {

/// The lines drawn by hand: the pen, their list, and what removes them.
class PenPanel : public QWidget {
  Q_OBJECT
 public:
  PenPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  void refresh();
  void removeSelected();

  EditorSession& session_;
  ViewSettings& view_;
  QPushButton* draw_;
  QListWidget* list_;
  QPushButton* remove_;
  QPushButton* removeAll_;
  bool filling_ = false;
};

}  // namespace batten
