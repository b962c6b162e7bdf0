// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <vector>

#include "core/fairing/profile/curve_comparison.h"
#include "ui/session/editor_session.h"

class QComboBox;
class QLabel;

namespace batten {

class FigureTable;
class SegmentedControl;
class ShapeView;

/// How alike two curves of the drawing are, each sketched, faired or a target of the selected one, whatever their size
/// and place (003 section 5); and how fair the selected curve is: the similarities of Table 1 with what S alone does
/// not tell.
class ShapeWindow : public QDialog {
  Q_OBJECT
 public:
  explicit ShapeWindow(EditorSession& session, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent*) override;

 private:
  /// Something that has a shape: a curve as sketched or faired, or a target of the selected curve.
  struct Entry {
    enum class Kind { Sketched, Faired, Target };
    Kind kind = Kind::Sketched;
    int number = 0;  ///< Of the curve from 0, or the target's degree.
    bool operator==(const Entry&) const = default;
  };
  QString nameOf(const Entry& entry) const;
  ShapeProfile profileOf(const Entry& entry) const;
  std::vector<Entry> entries() const;
  void refill();
  void compare();
  void refreshTable();
  void fitHeight();

  EditorSession& session_;
  std::vector<Entry> entries_;
  QComboBox* first_;
  QComboBox* second_;
  SegmentedControl* quantity_;
  ShapeView* view_;
  FigureTable* figures_;
  FigureTable* table_;
  QLabel* way_;
  QLabel* recommendation_;
};

}  // namespace batten
