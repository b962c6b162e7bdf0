// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

#include "ui/panels/rail/panel_stage.h"

namespace batten {

class EditorSession;
class StageButton;

/// The stages at the left edge: any can be chosen at any time; a dot says how far each has got.
class StageRail : public QWidget {
  Q_OBJECT
 public:
  explicit StageRail(EditorSession& session, QWidget* parent = nullptr);
  PanelStage current() const { return current_; }
  void setCurrent(PanelStage stage);
  /// The export of the present result has been written.
  void setExported(bool exported);

 signals:
  void chosen(batten::PanelStage stage);

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  void refresh();
  EditorSession& session_;
  std::vector<StageButton*> buttons_;
  PanelStage current_ = PanelStage::Scan;
  bool exported_ = false;
};

}  // namespace batten
