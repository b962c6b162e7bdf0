// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace batten {

/// Offers to rectify a sheet that was photographed at an angle, lets its corners be set on the drawing, and says what
/// was done.
class RectifyControls : public QWidget {
  Q_OBJECT
 public:
  RectifyControls(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  void build();
  void refresh();
  void rectify();
  void toggleTool(bool on);
  void say(const Result<void>& done);
  QString state() const;  ///< What is to be said of the page.

  EditorSession& session_;
  ViewSettings& view_;
  QLabel* note_;
  QPushButton* rectify_;
  QPushButton* corners_;
  QPushButton* whole_;
  QWidget* formatRow_ = nullptr;
  QComboBox* format_;
};

}  // namespace batten
