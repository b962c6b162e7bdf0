// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "ui/session/editor_session.h"
#include "ui/session/view/view_settings.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace batten {

class NumberField;

/// The true size of the drawing by other means than its resolution: a length measured on it, the paper it was drawn on,
/// or the width of what was scanned.
class ScaleControls : public QWidget {
  Q_OBJECT
 public:
  ScaleControls(EditorSession& session, ViewSettings& view, QWidget* parent = nullptr);

 private:
  void build();
  void refresh();
  void measureTaken();
  void setLength(double length);
  void chooseUnit();
  /// How many of the chosen unit one of another makes; 0: no unit of length.
  double lengthTypedIn(const QString& unit);
  void choosePaper(int index);
  void setWidth(double mm);
  void change(const QString& what, Recipe after);
  double millimetresPerUnit() const;

  EditorSession& session_;
  ViewSettings& view_;
  QPushButton* measure_;
  QWidget* lengthRow_ = nullptr;
  /// The number that was typed last, and what it was taken for.
  struct Typed {
    double number = 0.0, lengthMm = 0.0;
  };
  std::optional<Typed> typed_;
  bool namedUnit_ = false;  ///< A unit was typed behind the number.
  NumberField* length_;
  QComboBox* unit_;
  QComboBox* paper_;
  NumberField* width_;
  QLabel* note_;
};

}  // namespace batten
