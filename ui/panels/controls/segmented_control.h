// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QStringList>
#include <optional>

class QButtonGroup;

namespace batten {

/// A few words side by side of which one is chosen. Arrow keys move the choice.
class SegmentedControl : public QFrame {
  Q_OBJECT
 public:
  explicit SegmentedControl(const QStringList& labels, QWidget* parent = nullptr);
  int current() const;
  /// Shows a choice, or that none is made; emits nothing.
  void setCurrent(std::optional<int> index);
  /// Names of the buttons for tests and screen readers: "<prefix>.<word>".
  void setNames(const QString& prefix, const QStringList& words);
  void setSegmentEnabled(int index, bool enabled);
  /// Whether the words fit side by side in a width.
  static bool fits(const QStringList& labels, int widthPx);

 signals:
  void chosen(int index);

 private:
  QButtonGroup* group_;
};

}  // namespace batten
