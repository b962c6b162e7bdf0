// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

#include "core/fairing/profile/curve_comparison.h"

namespace batten {

/// The profiles of two shapes over each other: radius or curvature as multiples of its mean size (rms) over arc length
/// in percent, since the comparison does not depend on size.
class ShapeView : public QWidget {
  Q_OBJECT
 public:
  explicit ShapeView(QWidget* parent) : QWidget(parent) { setMinimumHeight(190); }
  /// Draws nothing but the empty frame where the comparison has no profiles. @param isRadius else curvature.
  void show(const ShapeComparison& comparison, bool isRadius);

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  struct Range {
    double low = 0.0, high = 1.0;
  };
  bool isEmpty() const { return first_.size() < 2 || second_.size() != first_.size(); }
  Range rangeOfBoth() const;
  std::vector<double> first_, second_;
  Range range_;
  bool isRadius_ = true;
};

}  // namespace batten
