// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <functional>
#include <vector>

class QPainter;

namespace batten {

/// What the marks on the drawing mean, a row a mark.
class Legend : public QWidget {
 public:
  explicit Legend(QWidget* parent = nullptr);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  struct Row {
    std::function<void(QPainter&, QPointF)> paint;  ///< The mark, at a place.
    QString meaning;
  };
  std::vector<Row> rows_;
};

}  // namespace batten
