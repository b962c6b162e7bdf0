// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/editor_session.h"

class QLabel;

namespace batten {

class FigureTable;

/// The neighbourhood filter and what it did to the ink.
class CleanUpPanel : public QWidget {
  Q_OBJECT
 public:
  explicit CleanUpPanel(EditorSession& session, QWidget* parent = nullptr);

 private:
  void refresh();
  EditorSession& session_;
  FigureTable* figures_;
  QLabel* warning_;
};

}  // namespace batten
