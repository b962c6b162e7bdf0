// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "ui/session/editor_session.h"
#include "ui/session/view/grey_scale.h"
#include "ui/session/view/view_settings.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QTableWidget;
class QTableWidgetItem;

namespace batten {

class NumberField;
class ParameterEditor;
class RegionHistogram;

/// What counts as ink: common settings, the selected region's histogram, and all 64 thresholds as a table.
class ThresholdPanel : public QWidget {
  Q_OBJECT
 public:
  ThresholdPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 protected:
  void changeEvent(QEvent*) override;
  void showEvent(QShowEvent*) override;

 private:
  void buildRegion();
  void refresh();
  void refreshRegion();
  void refreshTable();
  void setRegion(std::optional<int> region, std::optional<double> grey, GestureId gesture = {});
  void setAllAutomatic();
  void readCell(QTableWidgetItem* item);
  double levelOf(int region) const;
  bool eventFilter(QObject*, QEvent*) override;

  EditorSession& session_;
  ViewSettings& view_;
  GreyScale scale_;  ///< On which the panel shows levels now.
  ParameterEditor* editor_;
  QLabel* regionName_;
  RegionHistogram* histogram_;
  NumberField* level_;
  QPushButton* regionAuto_;
  QPushButton* allAuto_;
  QTableWidget* table_;
  QCheckBox* showRegions_;
  QLabel* note_;
  std::weak_ptr<const Scan> countedIn_;  ///< What counts_ were counted in.
  std::optional<int> countedRegion_;
  std::array<std::uint32_t, 256> counts_{};
  GestureId gesture_;
  bool filling_ = false;
};

}  // namespace batten
