// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/session/editor_session.h"

class QLabel;

namespace batten {

class SegmentedControl;

/// How the selected line is followed: as the page, along its outline or its middle.
class LineTraceMode : public QWidget {
  Q_OBJECT
 public:
  explicit LineTraceMode(EditorSession& session, QWidget* parent = nullptr);

 private:
  void refresh();
  EditorSession& session_;
  SegmentedControl* modes_;
  QLabel* hint_;
};

}  // namespace batten
