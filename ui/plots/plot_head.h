// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

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
  QSize minimumSizeHint() const override;

 signals:
  void chosen(batten::PlotTab tab);
  void reverseAsked(bool reversed);

 protected:
  void resizeEvent(QResizeEvent*) override;

 private:
  /// What stands on a tab, and what does where there is little room.
  struct TabNames {
    QToolButton* button = nullptr;
    QString text, shortText;
  };

  std::vector<TabNames> names_;
  QButtonGroup* tabs_;
  QToolButton* reverse_;
  QLabel* value_;
};

}  // namespace batten
