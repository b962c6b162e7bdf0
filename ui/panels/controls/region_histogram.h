// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>
#include <cstdint>

namespace batten {

/// How often each grey level occurs in a region, with the threshold as a line that can be dragged or moved by arrow
/// keys.
class RegionHistogram : public QWidget {
  Q_OBJECT
 public:
  explicit RegionHistogram(QWidget* parent = nullptr);
  void show(const std::array<std::uint32_t, 256>& counts, double threshold);
  void clear();
  QSize sizeHint() const override { return {272, 112}; }

 signals:
  void dragStarted();
  void thresholdMoved(double grey);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void keyPressEvent(QKeyEvent*) override;

 private:
  QRectF plot() const;
  void moveTo(double x);
  std::array<std::uint32_t, 256> counts_{};
  double threshold_ = 0.0;
  bool hasData_ = false;
  bool dragging_ = false;
};

}  // namespace batten
