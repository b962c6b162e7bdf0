// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QSizeF>

#include "core/pipeline/recipe/recipe.h"

class QPushButton;

namespace batten {

class NumberField;
class SegmentedControl;

/// Asks for the size of an empty page.
class NewDrawingDialog : public QDialog {
  Q_OBJECT
 public:
  explicit NewDrawingDialog(QWidget* parent = nullptr);
  /// A recipe of nothing but the page asked for and its resolution.
  Recipe recipe() const;
  static Recipe recipeFor(QSizeF millimetres, double dpi);

 private:
  struct FieldRow {
    QString label, name;
    double low, high, value;
    QString unit;
  };
  void addField(NumberField* field, const FieldRow& its);
  void addButtons();
  void follow();
  SegmentedControl* format_;
  NumberField *width_, *height_, *dpi_;
  QPushButton* begin_;
};

}  // namespace batten
