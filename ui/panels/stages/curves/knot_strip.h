// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

namespace batten {

/// A knot vector as a picture: one column a knot value, as many dots as the value is repeated. Corners are red.
class KnotStrip : public QWidget {
  Q_OBJECT
 public:
  explicit KnotStrip(QWidget* parent = nullptr);
  struct Column {
    double value = 0.0;
    int times = 1;
  };
  void setKnots(const std::vector<double>& knots);
  const std::vector<Column>& columns() const { return columns_; }
  QSize sizeHint() const override { return {240, 64}; }

 protected:
  void paintEvent(QPaintEvent*) override;
  bool event(QEvent*) override;

 private:
  double xOf(std::size_t column) const;
  std::vector<Column> columns_;
};

/// Equal knots taken together.
std::vector<KnotStrip::Column> knotColumns(const std::vector<double>& knots);

}  // namespace batten
