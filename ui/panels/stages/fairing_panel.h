// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <functional>
#include <optional>

#include "ui/session/editor_session.h"

class QPushButton;
class QVBoxLayout;

namespace batten {

class EndsTable;
class FigureTable;
class ParameterEditor;
class ParameterRow;
class FairingLinks;
class LinesNote;
class SegmentedControl;
class ToleranceOffer;

/// How curves are faired: for all of them or for the selected one alone; the tolerance; before and after.
class FairingPanel : public QWidget {
  Q_OBJECT
 public:
  explicit FairingPanel(EditorSession& session, QWidget* parent = nullptr);

 signals:
  void comparisonAsked();  ///< The user wants to compare shapes.

 private:
  QVBoxLayout* column() const;
  void buildScopeAndMode();
  void buildTolerance();
  /// Rows that only one of the modes has.
  void buildSettingsOfModes();
  void refresh();
  void refreshFigures();
  /// Settings that the controls show: the selected curve's own where they act on it alone.
  FairingParams shown(const Recipe& recipe) const;
  bool actsOnOne() const { return oneCurve_; }
  void setMode(FairingMode mode);
  void bindToScope(ParameterRow* row, const std::function<void(PieceChoice&, const FairingParams&)>& store);
  void buildNote();
  void buildLinks();
  void buildProfiles();
  void buildFigures();
  void followSession();
  void refreshModeSettings(const FairingParams& params);
  void setHold(int end, EndHold hold);
  /// To what the selected curve needs to reach its target.
  void raiseTolerance();
  void useForAll();
  void followAll();

  EditorSession& session_;
  SegmentedControl* scope_;
  SegmentedControl* mode_;
  ParameterRow* tolerance_;
  ParameterRow* keep_;
  ParameterRow* wavelength_;
  ParameterRow* policy_;
  ParameterRow* moves_;
  ParameterEditor* editor_;
  QWidget* ofMode_ = nullptr;  ///< The room of the rows above.
  LinesNote* note_;
  QPushButton* raise_;
  ToleranceOffer* offer_;  ///< Only what is enough is offered.
  FairingLinks* links_;
  FigureTable* figures_;
  EndsTable* ends_;
  bool oneCurve_ = false;
  std::optional<int> lastSelected_;
};

}  // namespace batten
