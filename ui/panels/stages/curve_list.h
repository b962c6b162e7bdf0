// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>

#include "ui/session/editor_session.h"
#include "ui/session/judged_curve.h"

namespace batten {

/// All curves of the drawing: an eye that takes a curve in or leaves it out (Space does the same), its name, its
/// figures, and a sign where its construction has something to say, which the tool tip does. Of results it says which
/// ones fairing left as drawn, and why.
class CurveList : public QListWidget {
  Q_OBJECT
 public:
  /// @param judged whose figures stand beside the names.
  CurveList(EditorSession& session, Judged judged, QWidget* parent = nullptr);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {120, 30}; }

 protected:
  void keyPressEvent(QKeyEvent*) override;
  void mousePressEvent(QMouseEvent*) override;

 private:
  void refresh();
  EditorSession& session_;
  Judged judged_;
  bool filling_ = false;
};

}  // namespace batten
