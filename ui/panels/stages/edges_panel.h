// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QCheckBox;
class QLabel;
class QPushButton;

namespace batten {

class FigureTable;
class SegmentedControl;

/// Which lines are followed, what of the page is traced, and how many lines that gave.
class EdgesPanel : public QWidget {
  Q_OBJECT
 public:
  EdgesPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  void buildChoice();
  void refresh();
  void buildJunctions();
  void refreshChoice();
  void refreshJunctions();
  EditorSession& session_;
  std::vector<QWidget*> tracing_;  ///< What is about the lines of the scan.
  ViewSettings& view_;
  SegmentedControl* tools_;
  QLabel* regions_;
  QPushButton* clear_;
  QCheckBox* strokes_;
  QCheckBox* fallback_;
  QCheckBox* junctions_;
  QPushButton* pair_;
  QPushButton* unpair_;
  FigureTable* figures_;
  QLabel* note_;
};

}  // namespace batten
