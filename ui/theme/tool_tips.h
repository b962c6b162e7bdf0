// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPoint>
#include <QString>

class QFontMetrics;
class QWidget;

namespace batten {

/// A text in lines no wider than asked, broken at blanks; its own line breaks stay.
QString inLines(const QString& text, const QFontMetrics& metrics, int widthPx);

/// Shows a tool tip in lines that are read at a glance. Qt writes each sentence on one line across the window.
void showToolTip(const QPoint& globalPosition, const QString& text, QWidget* of);

/// Sees to it that the tool tips of all widgets and of the rows of lists are shown so.
class ToolTipLines : public QObject {
 public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace batten
