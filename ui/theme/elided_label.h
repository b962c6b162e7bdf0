// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>

namespace batten {

/// A line of text that may be narrower than its text: then it ends in "…", and its tool tip holds the whole.
class ElidedLabel final : public QLabel {
 public:
  explicit ElidedLabel(QWidget* parent);
  QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }

 protected:
  bool event(QEvent*) override;
  void paintEvent(QPaintEvent*) override;
};

}  // namespace batten
