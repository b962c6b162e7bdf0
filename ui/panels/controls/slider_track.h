// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSlider>

namespace batten {

/// A thin slider: a press anywhere takes the knob there and drags on.
class SliderTrack : public QSlider {
  Q_OBJECT
 public:
  static constexpr int kSteps = 2000;  // of the range: finer than the track has pixels
  explicit SliderTrack(QWidget* parent = nullptr);
  QSize sizeHint() const override { return {120, 18}; }
  QSize minimumSizeHint() const override { return {40, 18}; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent*) override;

 private:
  int valueAt(double x) const;
};

}  // namespace batten
