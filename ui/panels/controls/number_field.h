// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QString>
#include <functional>
#include <optional>

class QLabel;
class QLineEdit;

namespace batten {

/// A number with its unit that can be typed; arrow keys step it. Takes a point or a comma; shows what cannot be read.
/// Enter ends the typing; whoever owns the window may take the keyboard then.
class NumberField : public QFrame {
  Q_OBJECT
 public:
  explicit NumberField(QWidget* parent = nullptr);
  void setRange(double minimum, double maximum);
  void setStep(double step) { step_ = step; }
  void setDecimals(int decimals) { decimals_ = decimals; }
  void setUnit(const QString& unit);
  /// How many of its own units one of another makes (0: no such unit), so that a number can be typed in that one too.
  void setOtherUnits(std::function<double(const QString& unit)> inOwnUnits) { inOwnUnits_ = std::move(inOwnUnits); }
  /// What the smallest value means, shown and taken in its place; empty = the number.
  void setMinimumText(const QString& text);
  /// Shows a value; emits nothing.
  void setValue(double value);
  /// Shows that there is no value.
  void setEmpty(const QString& placeholder);
  double value() const { return value_; }
  QLineEdit* edit() { return edit_; }

 signals:
  /// The user gave another value (bounded to the range).
  void committed(double value);
  /// Enter was pressed on a number that can be read: the field is done with, and the keys that follow are not for it.
  void entered();

 protected:
  bool eventFilter(QObject*, QEvent*) override;
  void focusInEvent(QFocusEvent*) override;

 private:
  void commit();
  void stepBy(int steps);
  void show(const char* property, bool on);
  QString format(double value) const;
  std::optional<double> read(QString text) const;

  QLineEdit* edit_;
  QLabel* unit_;
  QString minimumText_;
  std::function<double(const QString& unit)> inOwnUnits_;
  double minimum_ = 0.0, maximum_ = 1.0, step_ = 0.0, value_ = 0.0;
  int decimals_ = 0;
  bool empty_ = true;
};

}  // namespace batten
