// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <functional>

#include "core/pipeline/recipe/parameter_table.h"
#include "ui/session/editor_session.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;

namespace batten {

class NumberField;
class SegmentedControl;
class SliderTrack;

/// The control of one parameter, built from its table entry alone. Follows the recipe (undo, other controls) without
/// answering; a drag of its slider is one undo step; a double click on the name brings the default back.
class ParameterRow : public QWidget {
  Q_OBJECT
 public:
  /// Where the row reads and writes when not the parameter of the session's recipe itself.
  struct Binding {
    std::function<std::string(const Recipe&)> get;
    std::function<Result<void>(Recipe&, std::string_view)> set;
  };
  ParameterRow(EditorSession& session, const Parameter& parameter, QWidget* parent = nullptr);
  void setBinding(Binding binding);
  /// Another name or range than the table's, where the panel needs it shorter.
  void setLabel(const QString& label);
  void setUnit(const QString& unit);
  /// The stretch of the range that the slider covers; the field still takes all of it.
  void setSliderRange(double minimum, double maximum);
  void sync();
  const Parameter& parameter() const { return parameter_; }
  /// What the row is called, and the widget in it that takes the keyboard.
  QString title() const;
  QWidget* control() const;

 protected:
  bool eventFilter(QObject*, QEvent*) override;

 private:
  void build();
  void buildBoolean();
  void buildChoice();
  void buildNumber();
  void buildText();
  void give(const QString& text, GestureId gesture = {});
  void giveNumber(double value, GestureId gesture);
  GestureId gestureOfKeys();
  double inOwnUnits(const QString& unit) const;
  void showOtherUnit(double value);
  double fromTrack(int position) const;
  int toTrack(double value) const;

  EditorSession& session_;
  const Parameter& parameter_;
  Binding binding_;
  QLabel* name_ = nullptr;
  QCheckBox* check_ = nullptr;
  SegmentedControl* segments_ = nullptr;
  QComboBox* combo_ = nullptr;
  NumberField* field_ = nullptr;
  SliderTrack* track_ = nullptr;
  QLineEdit* text_ = nullptr;
  double low_ = 0.0, high_ = 1.0;
  GestureId gesture_;
  QElapsedTimer lastKey_;
};

}  // namespace batten
