// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "ui/panels/controls/panel_parts.h"
#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QLabel;
class QPushButton;

namespace batten {

class KnotPanel;
class MethodTable;
class GrowingControls;
class ParameterEditor;
class SegmentedControl;
class SelectedWidth;

/// How lines become curves, the curves themselves, and the figures of the selected one.
class CurvesPanel : public QWidget {
  Q_OBJECT
 public:
  CurvesPanel(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 signals:
  void helpAsked(const QString& page);

 protected:
  void showEvent(QShowEvent*) override;
  void hideEvent(QHideEvent*) override;

 private:
  void refresh();
  void refreshRows();
  void refreshFigures();
  /// The row of the detail acts on all curves or on the selected one alone.
  void bindDetail();
  bool detailsOne() const;
  /// One line below the list: choices whose line is not there now.
  void addWaitingRow();
  /// What the fair fit says of the selected curve: noise, spared control points, dropped extrema.
  void addFitRows(std::vector<FigureTable::Row>& rows, const TracedCurve& curve) const;
  /// Measured in the background while the panel is seen.
  void addWidthRow(std::vector<FigureTable::Row>& rows) const;
  EditorSession& session_;
  ParameterEditor* editor_;
  SegmentedControl* detailScope_;
  MethodTable* methods_;
  KnotPanel* knots_;
  FigureTable* figures_;
  SelectedWidth* width_;
  QLabel* note_;
  QLabel* waiting_;
  QPushButton* forget_;
  QLabel* segmentsNote_;
  GrowingControls* growing_;
};

}  // namespace batten
