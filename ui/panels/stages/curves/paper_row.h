// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

#include "ui/session/editor_session.h"

class QLabel;
class QPushButton;

namespace batten {

/// "As in the paper": a click sets everything as one of the papers has it, or back; a line says what that costs.
class PaperRow : public QWidget {
  Q_OBJECT
 public:
  explicit PaperRow(EditorSession& session, QWidget* parent = nullptr);
  /// The line: to be laid out where it may grow.
  QWidget* cost() const;

 private:
  void refresh();

  EditorSession& session_;
  std::vector<QPushButton*> links_;
  QLabel* cost_;
};

}  // namespace batten
