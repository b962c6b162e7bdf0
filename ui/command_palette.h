// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QList>

class QAction;
class QLineEdit;
class QListWidget;

namespace batten {

/// What the finder says of an action while it is disabled.
void setWhyNot(QAction& action, const QString& why);

/// Finds an action by a few letters of its name or help and does it. Opens over the canvas, closes with Escape.
class CommandPalette : public QFrame {
  Q_OBJECT
 public:
  explicit CommandPalette(QWidget* parent);
  void open(const QList<QAction*>& actions);

  /// How well letters match a text: none if they do not occur in order, larger is better.
  static int score(const QString& letters, const QString& text);

 protected:
  bool eventFilter(QObject*, QEvent*) override;
  void paintEvent(QPaintEvent*) override;

 private:
  void refresh();
  void runCurrent();
  QLineEdit* edit_;
  QListWidget* list_;
  QList<QAction*> actions_, shown_;
};

}  // namespace batten
