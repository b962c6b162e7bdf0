// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/ends_table.h"

#include <QAbstractButton>
#include <QPainter>

#include "ui/panels/controls/panel_parts.h"
#include "ui/theme/theme.h"

namespace batten {
namespace {

constexpr int kEndRow = 24;     // [px] height
constexpr int kEndColumn = 56;  // [px] width

/// A dot that is full when held.
class HoldDot : public QAbstractButton {
 public:
  explicit HoldDot(QWidget* parent) : QAbstractButton(parent) {
    setCheckable(true);
    setFocusPolicy(Qt::StrongFocus);
    setFixedSize(20, kEndRow - 2);
    setCursor(Qt::PointingHandCursor);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = themeOf(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    if (hasFocus()) drawFocusRing(painter, rect(), 5, theme);
    const QColor color = isEnabled() ? theme.text : theme.mute;
    painter.setPen(QPen(color, 1.3));
    painter.setBrush(isChecked() ? QBrush(color) : Qt::NoBrush);
    painter.drawEllipse(QRectF(rect()).center(), 4, 4);
  }
};

}  // namespace

EndsTable::EndsTable(std::function<FairingParams()> shown, std::function<void(int, EndHold)> set, QWidget* parent)
    : QWidget(parent), shown_(std::move(shown)), set_(std::move(set)) {
  setFixedHeight(4 * kEndRow);
  const std::array<QString, 2> ends = {tr("start"), tr("end")};
  const std::array<QString, 2> endNames = {QStringLiteral("start"), QStringLiteral("end")};
  const std::array<QString, 3> rows = {tr("Position"), tr("Tangent"), tr("Curvature")};
  const std::array<QString, 3> rowNames = {QStringLiteral("position"), QStringLiteral("tangent"),
                                           QStringLiteral("curvature")};
  const std::array<QString, 3> help = {tr("The end points of an open curve are always fixed."),
                                       tr("Holds the tangent at this end."),
                                       tr("Holds the tangent and the curvature at this end.")};
  // Row by row, as Tab walks them.
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t end = 0; end < 2; ++end) {
      auto* dot = new HoldDot(this);
      dot->setObjectName(QStringLiteral("fairing.hold_%1.%2").arg(endNames[end], rowNames[row]));
      dot->setAccessibleName(tr("Hold %1 at %2").arg(rows[row].toLower(), ends[end]));
      dot->setToolTip(help[row]);
      dots_[end][row] = dot;
      connect(dot, &QAbstractButton::clicked, this,
              [this, end, row](bool on) { toggle(static_cast<int>(end), static_cast<int>(row), on); });
    }
  }
  for (const auto& ofEnd : dots_) ofEnd[0]->setEnabled(false);
}

void EndsTable::refresh() {
  const FairingParams params = shown_();
  const std::array<EndHold, 2> holds = {params.startHold, params.endHold};
  for (std::size_t end = 0; end < 2; ++end) {
    dots_[end][0]->setChecked(true);
    dots_[end][1]->setChecked(holds[end].tangent);
    dots_[end][2]->setChecked(holds[end].curvature);
  }
}

void EndsTable::toggle(int end, int row, bool on) {
  // Holding the bend without the direction means nothing: each step holds what the one before holds.
  EndHold hold;
  if (row == 1) hold = on ? EndHold{true, false} : EndHold{false, false};
  if (row == 2) hold = on ? EndHold{true, true} : EndHold{true, false};
  set_(end, hold);
  refresh();
}

void EndsTable::resizeEvent(QResizeEvent*) {
  for (std::size_t end = 0; end < 2; ++end)
    for (std::size_t row = 0; row < 3; ++row)
      // The dot's middle stands under the end of the word above.
      dots_[end][row]->move(width() - (1 - static_cast<int>(end)) * kEndColumn - 20,
                            (static_cast<int>(row) + 1) * kEndRow);
}

void EndsTable::paintEvent(QPaintEvent*) {
  const Theme& theme = themeOf(palette());
  QPainter painter(this);
  painter.setFont(uiFont(12));
  const std::array<QString, 3> rows = {tr("Hold position"), tr("Hold tangent"), tr("Hold curvature")};
  painter.setPen(theme.mute);
  // The caption of the table stands in the line of its header, where it takes no room of its own.
  painter.setFont(captionFont());
  painter.drawText(QRect(0, 0, width(), kEndRow), Qt::AlignVCenter | Qt::AlignLeft, tr("Ends").toUpper());
  painter.setFont(uiFont(12));
  const auto column = [this](int end) { return QRect(width() - (2 - end) * kEndColumn, 0, kEndColumn, kEndRow); };
  painter.drawText(column(0), Qt::AlignVCenter | Qt::AlignRight, tr("start"));
  painter.drawText(column(1), Qt::AlignVCenter | Qt::AlignRight, tr("end"));
  for (int row = 0; row < 3; ++row) {
    const int y = (row + 1) * kEndRow;
    painter.setPen(theme.text);
    painter.drawText(QRect(0, y, width(), kEndRow), Qt::AlignVCenter | Qt::AlignLeft, rows[row]);
    painter.fillRect(0, y + kEndRow - 1, width(), 1, theme.line);
  }
}

}  // namespace batten
