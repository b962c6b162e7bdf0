// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace batten {

/// A message inside the window: what is wrong, what to do, and a button that does it. Never a box in the way: it lies
/// over the upper edge of the drawing, so that no control moves when it comes or goes.
class ErrorStrip : public QWidget {
  Q_OBJECT
 public:
  explicit ErrorStrip(QWidget* parent = nullptr);
  /// Where it is shown. @pre both have the same window
  void layOver(QWidget* drawing);
  /// @param action text of the button that helps; empty = only Dismiss.
  /// @param dismiss text of the button that hides the message; empty = "Dismiss".
  void show(const QString& message, const QString& action, const QString& dismiss = {});
  QString message() const;

 signals:
  void actionPressed();
  void dismissed();

 protected:
  void paintEvent(QPaintEvent*) override;
  bool eventFilter(QObject*, QEvent*) override;

 private:
  void place();
  QWidget* drawing_ = nullptr;
  QLabel* text_;
  QPushButton *action_, *dismiss_;
};

}  // namespace batten
