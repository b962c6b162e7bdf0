// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/controls/panel_parts.h"

#include <QCoreApplication>
#include <QHBoxLayout>
#include <QHelpEvent>
#include <QLabel>
#include <QLayout>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <cmath>

#include "core/fairing/profile/target_degrees.h"
#include "ui/theme/theme.h"
#include "ui/theme/tool_tips.h"

namespace batten {
namespace {
constexpr int kRowHeight = 24;    // px
constexpr int kColumnWidth = 64;  // [px] of a field
constexpr int kWideColumn = 72;   // where the heads of many columns would touch

void addLaidOut(QLayout* layout, std::vector<QWidget*>& found);

void addLaidOut(QWidget* widget, std::vector<QWidget*>& found) {
  if (widget->focusPolicy() & Qt::TabFocus) return found.push_back(widget);
  if (widget->layout() != nullptr) return addLaidOut(widget->layout(), found);
  // What places its parts by itself has made them in their order.
  for (auto* part : widget->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) addLaidOut(part, found);
}

void addLaidOut(QLayout* layout, std::vector<QWidget*>& found) {
  for (int i = 0; i < layout->count(); ++i) {
    QLayoutItem* item = layout->itemAt(i);
    if (item->widget() != nullptr)
      addLaidOut(item->widget(), found);
    else if (item->layout() != nullptr)
      addLaidOut(item->layout(), found);
  }
}
}  // namespace

void tabAsLaidOut(const std::vector<QWidget*>& parts) {
  std::vector<QWidget*> found;
  for (QWidget* part : parts) addLaidOut(part, found);
  for (std::size_t i = 1; i < found.size(); ++i) QWidget::setTabOrder(found[i - 1], found[i]);
}

QLabel* heading(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(uiFont(13, QFont::DemiBold));
  return label;
}

QFont captionFont() {
  QFont font = uiFont(11, QFont::DemiBold);
  font.setLetterSpacing(QFont::AbsoluteSpacing, 0.4);
  return font;
}

QLabel* caption(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text.toUpper(), parent);
  label->setFont(captionFont());
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setContentsMargins(0, kCaptionMargin, 0, 0);
  label->setAccessibleName(text);
  return label;
}

QLayout* captionRow(const QString& text, const std::vector<QPushButton*>& links, QWidget* parent) {
  auto* row = new QHBoxLayout;
  row->setSpacing(10);
  row->addWidget(caption(text, parent), 1);
  for (QPushButton* link : links) row->addWidget(link);
  return row;
}

QLabel* note(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setFont(uiFont(12));
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setWordWrap(true);
  return label;
}

QPushButton* plainButton(const QString& text, const QString& name, QWidget* parent) {
  auto* button = new QPushButton(text, parent);
  button->setObjectName(name);
  button->setAccessibleName(text);
  return button;
}

QPushButton* linkButton(const QString& text, const QString& name, QWidget* parent) {
  auto* button = plainButton(text, name, parent);
  button->setProperty("flat", true);
  button->setCursor(Qt::PointingHandCursor);
  return button;
}

FigureTable::FigureTable(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void FigureTable::setHeader(const QString& first, const QStringList& columns) {
  first_ = first;
  columns_ = columns;
  updateGeometry();
}

void FigureTable::setTitle(const QString& title) {
  title_ = title.toUpper();
  setAccessibleName(title);
  update();
}

void FigureTable::setRows(std::vector<Row> rows) {
  rows_ = std::move(rows);
  QStringList spoken;
  for (const Row& row : rows_) {
    QString line = row.name;
    for (const Cell& cell : row.cells) line += QLatin1Char(' ') + cell.text;
    spoken << line;
  }
  setAccessibleDescription(spoken.join(QStringLiteral("; ")));
  updateGeometry();
  update();
}

QSize FigureTable::sizeHint() const {
  return {240, kRowHeight * (static_cast<int>(rows_.size()) + (columns_.isEmpty() ? 0 : 1))};
}

void FigureTable::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setFont(uiFont(12));
  int y = 0;
  const auto columnRect = [&](int fromRight, int top, int columns) {
    const int w = columns == 1 ? width() / 2 : columns > 3 ? kWideColumn : kColumnWidth;
    return QRect(width() - (fromRight + 1) * w, top, w, kRowHeight);
  };
  const int shownColumns = static_cast<int>(columns_.size());
  if (shownColumns > 0) {
    painter.setPen(theme.mute);
    if (!title_.isEmpty()) painter.setFont(captionFont());
    const QRect room(0, y, columnRect(shownColumns - 1, y, std::max(2, shownColumns)).left(), kRowHeight);
    painter.drawText(
        room, Qt::AlignVCenter | Qt::AlignLeft,
        painter.fontMetrics().elidedText(title_.isEmpty() ? first_ : title_, Qt::ElideRight, room.width()));
    painter.setFont(uiFont(12));
    for (int c = 0; c < shownColumns; ++c)
      painter.drawText(columnRect(shownColumns - 1 - c, y, std::max(2, shownColumns)),
                       Qt::AlignVCenter | Qt::AlignRight, columns_[c]);
    y += kRowHeight;
  }
  for (const Row& row : rows_) {
    painter.setPen(theme.text);
    painter.drawText(QRect(0, y, width(), kRowHeight), Qt::AlignVCenter | Qt::AlignLeft, row.name);
    const int count = static_cast<int>(row.cells.size());
    for (int c = 0; c < count; ++c) {
      const Cell& cell = row.cells[c];
      painter.setPen(cell.warns ? theme.amber : theme.text);
      painter.drawText(columnRect(count - 1 - c, y, std::max(count, shownColumns)), Qt::AlignVCenter | Qt::AlignRight,
                       cell.text);
    }
    painter.fillRect(0, y + kRowHeight - 1, width(), 1, theme.line);
    y += kRowHeight;
  }
}

bool FigureTable::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const int index = help->pos().y() / kRowHeight - (columns_.isEmpty() ? 0 : 1);
    const bool inside = index >= 0 && index < std::ssize(rows_);
    showToolTip(help->globalPos(), inside ? rows_[index].help : QString(), this);
    return true;
  }
  return QWidget::event(event);
}

QString millimetres(double mm) {
  const double size = std::abs(mm);
  const int decimals = size >= 100 ? 1 : size >= 0.1 || size == 0 ? 2 : 3;
  return QString::number(mm, 'f', decimals) + QStringLiteral(" mm");
}

QString shortMillimetres(double mm) {
  const double size = std::abs(mm);
  const int decimals = size >= 99.95 ? 0 : size >= 9.995 ? 1 : size >= 0.0995 ? 2 : 3;
  return QString::number(mm, 'f', decimals) + QStringLiteral(" mm");
}

QString zoomText(double zoom) { return QStringLiteral("%1 %").arg(zoom * 100, 0, 'f', zoom < 0.0995 ? 1 : 0); }

QString areaText(double mm2) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(std::max(mm2, 1e-4)))), 0, 4);
  return QString::number(mm2, 'f', decimals) + QStringLiteral(" mm²");
}

QString grouped(qint64 count) {
  QString digits = QString::number(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > (count < 0 ? 1 : 0); at -= 3)
    digits.insert(at, QChar(0x2009));
  return digits;
}

QString similarityText(double s) {
  QString text = QString::number(s, 'f', 4);
  if (text.startsWith(QLatin1String("0."))) text.remove(0, 1);
  if (text.startsWith(QLatin1String("-0."))) text = QChar(0x2212) + text.mid(2, 3);
  return text;
}

QString counted(qint64 count, const QString& one, const QString& many) {
  return count == 1 ? one : many.arg(grouped(count));
}

QString degreeName(int degree) {
  static const PerTarget<const char*> kNames = {
      QT_TRANSLATE_NOOP("Degree", "linear"),  QT_TRANSLATE_NOOP("Degree", "quadratic"),
      QT_TRANSLATE_NOOP("Degree", "cubic"),   QT_TRANSLATE_NOOP("Degree", "quartic"),
      QT_TRANSLATE_NOOP("Degree", "quintic"), QT_TRANSLATE_NOOP("Degree", "sextic")};
  if (!isTargetDegree(degree)) return {};
  return QCoreApplication::translate("Degree", kNames[degree - 1]);
}

}  // namespace batten
