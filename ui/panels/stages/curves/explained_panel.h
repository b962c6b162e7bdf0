// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QCheckBox;
class QLabel;

namespace batten {

class FigureTable;

/// Shows on the drawing what ink the curves miss and what they invent, and by how much.
class ExplainedPanel : public QWidget {
  Q_OBJECT
 public:
  ExplainedPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  void refresh();

  EditorSession& session_;
  ViewSettings& view_;
  QCheckBox* show_;
  FigureTable* figures_;
  QLabel* note_;
};

}  // namespace batten
