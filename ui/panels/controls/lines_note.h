// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>

namespace batten {

/// A note with room for so many lines, whatever it says, so that what stands below it stays where it is. A longer text
/// ends in "… more"; a click on it, or Space when it has the keyboard, shows the whole, as its tool tip does.
class LinesNote final : public QLabel {
 public:
  LinesNote(int lines, QWidget* parent);
  void setText(const QString& text);
  void setLines(int lines);
  /// [px] The height of so many lines.
  int roomFor(int lines) const;
  /// The lines as they are shown.
  QStringList shownLines() const;
  bool isCut() const { return isCut_; }

 protected:
  void changeEvent(QEvent*) override;
  bool event(QEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  /// Where the text is cut.
  void showWhole();
  /// The keyboard and the mouse stop at a note only where there is more to read.
  void findCut();
  QString moreText() const;
  int lines_;
  bool isCut_ = false;
};

/// The widget keeps its room while it is hidden.
void keepRoom(QWidget* widget);

}  // namespace batten
