// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>
#include <set>

#include "ui/session/editor_session.h"

class QComboBox;
class QListWidget;

namespace batten {

/// Which curves an export holds: all that count, the selected one, or those that are ticked in a list. Curves are known
/// by their numbers, so that a choice outlives a new run.
class ExportChoice : public QWidget {
  Q_OBJECT
 public:
  explicit ExportChoice(EditorSession& session, QWidget* parent = nullptr);

  /// Numbers of the curves to take; absent: all.
  std::optional<std::set<int>> numbers() const;
  /// What to do where nothing is chosen; empty: something is.
  QString obstacle() const;
  /// Shows the curves of the present result.
  void refresh();
  /// All curves again: for another drawing.
  void reset();

 signals:
  void changed();

 private:
  enum Selection { All, Selected, Ticked };
  void build();
  void tickAll(bool ticked);
  Selection selection() const;

  EditorSession& session_;
  QComboBox* selection_;
  QWidget* ticks_;
  QListWidget* list_;
  std::set<int> unticked_;  ///< So that a new curve is ticked.
  bool filling_ = false;
};

}  // namespace batten
