// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/drop_hint_layer.h"

#include <QCoreApplication>
#include <QPalette>
#include <QPen>

namespace batten {

void paintDropHint(QPainter& painter, const CanvasScene& scene) {
  const QSizeF view = QSizeF(scene.transform.viewSize()) / scene.transform.ratio();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF area(view.width() / 2.0 - 190.0, view.height() / 2.0 - 70.0, 380.0, 140.0);
  painter.setPen(QPen(scene.palette.color(QPalette::PlaceholderText), 1.5, Qt::DashLine));
  painter.setBrush(scene.palette.color(QPalette::Window));
  painter.drawRoundedRect(area, 10.0, 10.0);
  QFont font = scene.font;
  font.setPixelSize(15);
  painter.setFont(font);
  painter.setPen(scene.palette.color(QPalette::WindowText));
  const QString text = QCoreApplication::translate(
      "CurveCanvas", scene.session.isBusy() ? "Opening the scan…" : "Drop a scan here, or open one with Ctrl+O");
  painter.drawText(area, Qt::AlignCenter | Qt::TextWordWrap, text);
  painter.restore();
}

}  // namespace batten
