// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/fairing/profile/target_degrees.h"
#include "ui/panels/targets/target_tile.h"
#include "ui/session/editor_session.h"

namespace batten {

/// The six targets of the selected curve side by side, on the same axes.
class TargetStrip : public QWidget {
  Q_OBJECT
 public:
  explicit TargetStrip(EditorSession& session, QWidget* parent = nullptr);
  /// The highest tiles that fit into a height. They keep their profiles where no plot shows them.
  static int flatHeight();  ///< [px] The least that it takes beside a plot.
  void fitInto(int height, bool hasPlots);
  /// The tiles run as the plot below them does.
  void setRunsLeft(bool runsLeft);

 signals:
  void hint(const QString& text);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;

 private:
  void setTileHeight(int height);
  void refresh();
  void alignFigures();
  EditorSession& session_;
  PerTarget<TargetTile*> tiles_{};
};

}  // namespace batten
