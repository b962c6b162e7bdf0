// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "core/document/export_builder.h"
#include "core/exchange/model/export_settings.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace batten {

class NumberField;

/// What is written, and for whom: the receiver chooses the format, the rest are the few numbers it leaves open. What
/// was chosen last is remembered.
class ExportOptions : public QWidget {
  Q_OBJECT
 public:
  explicit ExportOptions(QWidget* parent = nullptr);

  ExportSettings settings() const;
  ExportedCurves which() const;
  /// Ending of the file's name, without its dot: "svg", "poly.csv".
  QString suffix() const;
  /// For the dialog that asks for a file: "DXF (*.dxf)".
  QString filter() const;
  /// Why this build cannot write what is chosen; empty: it can.
  QString obstacle() const;

 signals:
  void formatChanged();  ///< And with it the ending.
  void changed();

 private:
  void build();
  QWidget* row(const QString& label, QWidget* control, const QString& help);
  void choosePreset();
  void restore();
  void save() const;
  const ExportPreset& preset() const;

  QComboBox* presets_;
  QLabel* note_;
  QComboBox* which_;
  QComboBox* unit_;
  NumberField* scale_;
  NumberField* tolerance_;
  QCheckBox* joined_;
  QCheckBox* widths_;
  QWidget* unitRow_ = nullptr;
  QWidget* toleranceRow_ = nullptr;
};

}  // namespace batten
