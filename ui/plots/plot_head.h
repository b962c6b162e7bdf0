// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/plots/plot_series.h"

class QButtonGroup;
class QLabel;
class QToolButton;

namespace batten {

/// The line over the plot: which quantity it shows, which way it runs, and the value under the cursor.
class PlotHead : public QWidget {
  Q_OBJECT
 public:
  explicit PlotHead(QWidget* parent);
  void setTab(PlotTab tab);
  void setValue(const QString& text);
  void setReversed(bool reversed);

 signals:
  void chosen(batten::PlotTab tab);
  void reverseAsked(bool reversed);

 private:
  QButtonGroup* tabs_;
  QToolButton* reverse_;
  QLabel* value_;
};

}  // namespace batten
