// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QPushButton;

namespace batten {

class SegmentedControl;

/// Begins painting the trace mode of ink, and says what the brush makes of it.
class PaintControls : public QWidget {
  Q_OBJECT
 public:
  PaintControls(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  void refresh();

  EditorSession& session_;
  ViewSettings& view_;
  QPushButton* paint_;
  QPushButton* forget_;
  SegmentedControl* modes_;
};

}  // namespace batten
