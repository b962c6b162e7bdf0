// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPoint>
#include <optional>
#include <vector>

#include "ui/plots/plot_series.h"

class QCustomPlot;
class QMouseEvent;

namespace batten {

/// What can be dragged in the radius and curvature plots: the points of the drawn target (001 Fig. 18) and the splits,
/// and the menu under the right mouse button. Dragging the dashed target itself makes it a drawn one.
class PlotEditing : public QObject {
  Q_OBJECT
 public:
  PlotEditing(EditorSession& session, QCustomPlot* plot, QObject* parent);
  /// Draws handles and splits of new data over the plot's graphs. @pre they are there already.
  void show(const PlotData& data, PlotTab tab);
  /// What a press at this place would do; empty where it would do nothing.
  QString hintAt(const QPoint& position) const;
  bool isDragging() const { return dragged_ != Dragged::Nothing; }

 signals:
  void wholeAsked();  ///< Show the whole curve.

 protected:
  bool eventFilter(QObject*, QEvent*) override;

 private:
  enum class Dragged { Nothing, Handle, Split };
  bool press(const QMouseEvent& event);
  bool move(const QMouseEvent& event);
  void drag(const QPoint& position);
  void openMenu(const QPoint& position);
  bool isEditable() const;
  double fractionAt(int x) const;
  double kappaAt(int y, double signOf) const;
  std::optional<int> handleAt(const QPoint& position) const;
  std::optional<int> splitAt(const QPoint& position) const;
  /// Within reach of the area between the axes: where a press can take hold of something.
  bool isOverAxes(const QPoint& position) const;
  bool isOnTarget(const QPoint& position) const;

  EditorSession& session_;
  QCustomPlot* plot_;
  PlotData data_;
  PlotTab tab_ = PlotTab::Radius;
  Dragged dragged_ = Dragged::Nothing;
  std::optional<int> index_;  ///< Of the handle or split that is dragged.
  GestureId gesture_;
  QPoint pressedAt_;
  bool hasMoved_ = false;  ///< Since then, farther than a click may.
  std::vector<QObject*> items_;
};

}  // namespace batten
