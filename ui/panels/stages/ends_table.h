// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>
#include <functional>

#include "core/fairing/fairing_params.h"

class QAbstractButton;

namespace batten {

/// What fairing holds at the two ends of an open curve: position always, tangent and curvature as chosen.
class EndsTable : public QWidget {
  Q_OBJECT
 public:
  /// @param shown the fairing whose ends the table shows; @param set called with the end (0, 1) when the user changes
  /// it.
  EndsTable(std::function<FairingParams()> shown, std::function<void(int end, EndHold)> set, QWidget* parent);
  void refresh();

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  void toggle(int end, int row, bool on);
  std::function<FairingParams()> shown_;
  std::function<void(int, EndHold)> set_;
  std::array<std::array<QAbstractButton*, 3>, 2> dots_{};  ///< [start, end][position, tangent, curvature]
};

}  // namespace batten
