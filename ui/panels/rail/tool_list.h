// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QList>
#include <QWidget>

class QAction;

namespace batten {

/// The tools of the drawing, each with its key; follows their actions.
class ToolList : public QWidget {
  Q_OBJECT
 public:
  explicit ToolList(const QList<QAction*>& tools, QWidget* parent = nullptr);
};

}  // namespace batten
