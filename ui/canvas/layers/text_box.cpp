// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/text_box.h"

#include <QFontMetricsF>
#include <QPen>
#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double kMargin = 12.0;             // [widget px] from the border of the canvas
constexpr double kPadX = 10.0, kPadY = 6.0;  // [widget px] around the text

void paintBox(QPainter& painter, const CanvasScene& scene, const QString& text, const QRectF& box, double opacity) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(scene.font);
  QColor fill = scene.palette.color(QPalette::Base);
  fill.setAlphaF(static_cast<float>(opacity));
  painter.setBrush(fill);
  QColor line = scene.palette.color(QPalette::Text);
  line.setAlpha(40);
  painter.setPen(QPen(line, 1.0));
  painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 5.0, 5.0);
  painter.setPen(scene.palette.color(QPalette::Text));
  painter.drawText(box, Qt::AlignCenter, text);
  painter.restore();
}

QSizeF boxSize(const CanvasScene& scene, const QString& text, double padX, double padY) {
  const QFontMetricsF metrics(scene.font);
  return {std::ceil(metrics.horizontalAdvance(text) + 2.0 * padX), std::ceil(metrics.height() + 2.0 * padY)};
}

}  // namespace

namespace {

QRectF chipBox(const CanvasScene& scene, const QString& text, ChipPlace place) {
  const QSizeF size = boxSize(scene, text, kPadX, kPadY);
  const QSizeF view = QSizeF(scene.transform.viewSize()) / scene.transform.ratio();
  const bool right = place == ChipPlace::TopRight || place == ChipPlace::BottomRight;
  const bool bottom = place == ChipPlace::BottomLeft || place == ChipPlace::BottomRight;
  const QPointF corner(right ? view.width() - kMargin - size.width() : kMargin,
                       bottom ? view.height() - kMargin - size.height() : kMargin);
  return {corner, size};
}

}  // namespace

void paintChip(QPainter& painter, const CanvasScene& scene, const QString& text, ChipPlace place) {
  if (text.isEmpty()) return;
  const QRectF box = chipBox(scene, text, place);
  if (!scene.mouse || !box.contains(*scene.mouse)) paintBox(painter, scene, text, box, 0.93);
}

void paintChipBesidePage(QPainter& painter, const CanvasScene& scene, const QString& text) {
  if (text.isEmpty()) return;
  const QSize size = scene.transform.imageSize();
  const QRectF page(scene.transform.toWidget({0.0, 0.0}),
                    scene.transform.toWidget({static_cast<double>(size.width()), static_cast<double>(size.height())}));
  for (const ChipPlace place : {ChipPlace::TopRight, ChipPlace::BottomRight, ChipPlace::TopLeft, ChipPlace::BottomLeft})
    if (!chipBox(scene, text, place).intersects(page)) return paintChip(painter, scene, text, place);
}

bool isBesideChips(const CanvasScene& scene, QPointF mouse) {
  const double height = kMargin + boxSize(scene, QStringLiteral("0"), kPadX, kPadY).height();
  const double below = scene.transform.viewSize().height() / scene.transform.ratio() - mouse.y();
  return std::min(mouse.y(), below) <= height;
}

void paintLabel(QPainter& painter, const CanvasScene& scene, const QString& text, QPointF beside) {
  if (text.isEmpty()) return;
  const QSizeF size = boxSize(scene, text, 6.0, 2.0);
  const QSizeF view = QSizeF(scene.transform.viewSize()) / scene.transform.ratio();
  QRectF box(beside + QPointF(14.0, -size.height() - 8.0), size);
  if (box.right() > view.width()) box.moveRight(beside.x() - 14.0);
  if (box.top() < 0.0) box.moveTop(beside.y() + 10.0);
  paintBox(painter, scene, text, box, 0.95);
}

}  // namespace batten
