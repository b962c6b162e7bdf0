// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>

#include "ui/session/editor_session.h"

class QAbstractButton;

namespace batten {

/// What fairing holds at the two ends of an open curve: position always, tangent and curvature as chosen.
class EndsTable : public QWidget {
  Q_OBJECT
 public:
  explicit EndsTable(EditorSession& session, QWidget* parent = nullptr);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  void refresh();
  void toggle(int end, int row, bool on);
  EditorSession& session_;
  std::array<std::array<QAbstractButton*, 3>, 2> dots_{};  ///< [start, end][position, tangent, curvature]
};

}  // namespace batten
