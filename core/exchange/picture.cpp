// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/picture.h"

#include <QBuffer>
#include <QByteArray>
#include <QColor>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <QPen>

namespace batten {
namespace {

qsizetype bytesPerRow(const Picture& picture) { return 3 * static_cast<qsizetype>(picture.width); }

QPainterPath pathOf(const PictureLine& line) {
  QPainterPath path(QPointF(line.points.front().x(), line.points.front().y()));
  for (const Vec2& p : line.points) path.lineTo(p.x(), p.y());
  if (line.closed) path.closeSubpath();
  return path;
}

}  // namespace

void drawLines(Picture& picture, std::span<const PictureLine> lines) {
  if (picture.width <= 0 || picture.height <= 0) return;
  QImage view(picture.rgb.data(), picture.width, picture.height, bytesPerRow(picture), QImage::Format_RGB888);
  QPainter painter(&view);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const PictureLine& line : lines) {
    if (line.points.empty()) continue;
    painter.setPen(QPen(QColor(line.colour[0], line.colour[1], line.colour[2]), line.widthPx, Qt::SolidLine,
                        Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(pathOf(line));
  }
}

Result<std::string> encodePng(const Picture& picture) {
  const QImage view(picture.rgb.data(), picture.width, picture.height, bytesPerRow(picture), QImage::Format_RGB888);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (view.isNull() || !view.save(&buffer, "PNG")) {
    return fail(ErrorCode::OutOfMemory, "The picture is too large to be written as PNG. Use a smaller scan.");
  }
  return bytes.toStdString();
}

}  // namespace batten
