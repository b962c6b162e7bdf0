// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

class QLabel;
class QLineEdit;
class QPushButton;

namespace batten {

struct SaveQuestion;

/// Asks for the name of a file in a folder that stands: for folders and names whose bytes are no UTF-8, which Qt's file
/// dialogs cannot enter or name. Asks before a file is replaced.
class SaveHereDialog : public QDialog {
  Q_OBJECT
 public:
  static constexpr int kElsewhere = 2;  ///< Result, beside Accepted and Rejected: another folder is wanted.

  SaveHereDialog(const SaveQuestion&, QWidget* parent);
  /// What was accepted, with its suffix.
  QString path() const;

 private:
  void addButtons();
  void follow();
  void save();
  /// What is wrong with the name; empty: nothing.
  QString obstacle() const;
  void ask(const QString& text, bool replaces);

  QString folder_, suffix_;
  QLineEdit* name_;
  QLabel* message_;
  QPushButton* save_;
  bool confirmReplace_ = false;
};

}  // namespace batten
