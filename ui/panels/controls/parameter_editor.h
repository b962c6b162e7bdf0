// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>
#include <QWidget>
#include <string_view>
#include <vector>

#include "ui/session/editor_session.h"

class QToolButton;
class QVBoxLayout;

namespace batten {

class ParameterRow;

/// Controls for some parameters of the table, the expert ones folded under "More".
class ParameterEditor : public QWidget {
  Q_OBJECT
 public:
  ParameterEditor(EditorSession& session, const std::vector<std::string_view>& names, QWidget* parent = nullptr);
  ParameterRow* row(std::string_view name) const;
  /// Puts a control of its own right below the row of a parameter that is not folded.
  void addBelow(std::string_view name, QWidget* widget);
  void setRowVisible(std::string_view name, bool visible);
  /// Opens "More" if a row lies under it.
  void unfold(const QWidget* row);

 private:
  QVBoxLayout* layout_;
  QToolButton* more_ = nullptr;
  QWidget* folded_ = nullptr;
  std::vector<ParameterRow*> rows_;
};

}  // namespace batten
