// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <utility>

#include "ui/plots/plot_series.h"
#include "ui/session/view/view_settings.h"

namespace batten {

/// The plots under the canvas: radius, curvature and its slope, speed of the parameter and deviation over arc length of
/// the selected curve, the one that the view judges. They run as the curve lies on the drawing, from left to right. The
/// cursor is linked with the canvas both ways; the wheel zooms, a drag pans, a double click shows all.
class CurvePlots : public QWidget {
  Q_OBJECT
 public:
  CurvePlots(EditorSession& session, const ViewSettings& view, QWidget* parent = nullptr);
  ~CurvePlots() override;
  PlotTab tab() const;
  void setTab(PlotTab tab);
  /// Reverses the plot of the selected curve; another selection starts as its curve lies.
  void setReversed(bool reversed);
  bool isReversed() const;
  /// [px] With which axes and targets are read at ease; minimumSizeHint() is the least.
  int goodHeight() const;
  /// True while lengths count from right to left.
  bool runsLeft() const;
  /// Where a mark of the curvature plot is in the plot widget, for tests; outside when there is none.
  QPointF markPlace(int note) const;
  /// The stretch of the curve that the plot shows, as lengths along it [mm].
  std::pair<double, double> shownLengths() const;

 signals:
  void hint(const QString& text);
  /// After every change of runsLeft().
  void directionChanged(bool runsLeft);

 protected:
  void changeEvent(QEvent*) override;
  void showEvent(QShowEvent*) override;
  bool eventFilter(QObject*, QEvent*) override;
  void paintEvent(QPaintEvent*) override;

 private:
  void build();
  void refreshSoon();
  void refresh();
  void refreshData();
  /// Axes, their direction and names; what stands there while there is no curve.
  void showAxes();
  /// The part of new data that is shown: the same as before where that makes sense.
  void refreshView();
  void applyTheme();
  void showCursor();
  void resetView();
  const ExtremumMark* markAt(const QPointF& place) const;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace batten
