// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QImage>
#include <QPainter>
#include <QPainterPath>
#include <QString>
#include <QTemporaryDir>
#include <QTimer>
#include <functional>

#include "ui/session/editor_session.h"

namespace batten::test {

/// Turns the event loop until `done` or the (generous) limit; says whether it was done. Between events it sleeps: what
/// it waits for needs the processors.
inline bool waitUntil(const std::function<bool()>& done, int limitMs = 60000) {
  constexpr int kLookAgainMs = 2, kFollowUpMs = 20;
  QElapsedTimer timer;
  timer.start();
  QTimer again;
  again.start(kLookAgainMs);
  while (!done()) {
    if (timer.elapsed() > limitMs) return false;
    QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
  }
  QCoreApplication::processEvents(QEventLoop::AllEvents, kFollowUpMs);  // and what it set off
  return true;
}

/// A page of 300 dpi with what `draw` draws on it, with a dark pen of 5 px unless it takes another.
inline QImage drawnPage(QSize size, const std::function<void(QPainter&)>& draw) {
  QImage page(size, QImage::Format_Grayscale8);
  page.fill(245);
  page.setDotsPerMeterX(11811);
  page.setDotsPerMeterY(11811);
  QPainter painter(&page);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(30, 30, 30), 5.0, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin));
  draw(painter);
  return page;
}

/// A page with one open line of three strokes that meet in two sharp corners at (200, 100) and (400, 300), 300 dpi.
inline QImage zigzagPage(QSize size = {640, 400}) {
  return drawnPage(size, [](QPainter& painter) {
    painter.drawPolyline(QPolygonF({{60, 300}, {200, 100}, {400, 300}, {580, 80}}));
  });
}

/// A page with one filled ellipse: a smooth closed outline.
inline QImage ellipsePage(QSize size = {640, 400}) {
  return drawnPage(size, [size](QPainter& painter) {
    painter.setBrush(QColor(30, 30, 30));
    painter.setPen(Qt::NoPen);
    painter.drawEllipse(QRectF(0.2 * size.width(), 0.2 * size.height(), 0.6 * size.width(), 0.6 * size.height()));
  });
}

/// The defaults, but only marks make corners: for tests of what marks and whole lines do.
inline Recipe markedCornersOnly() {
  Recipe recipe;
  recipe.corners.automatic = false;
  return recipe;
}

/// A session with a page of its own, opened and computed. Corners are those that the test marks, unless it starts with
/// another recipe.
class OpenSession {
 public:
  explicit OpenSession(const QImage& page, const Recipe& start = markedCornersOnly()) {
    session.setStartRecipe(start);
    page.save(path());
    session.openScan(path());
    isReady = waitUntil([this] { return session.hasScan() && !session.isBusy(); });
  }
  QString path() const { return folder.filePath(QStringLiteral("page.png")); }
  bool settle() {
    return waitUntil([this] { return !session.isBusy(); });
  }

  QTemporaryDir folder;
  EditorSession session;
  bool isReady = false;
};

/// An arc, a wave and a closed line, so that targets fit one and not the other.
inline QImage mixedPage() {
  return drawnPage({640, 400}, [](QPainter& painter) {
    QPainterPath arc({40, 120});
    arc.quadTo({160, 20}, {300, 110});
    painter.drawPath(arc);
    painter.drawEllipse(360, 40, 220, 130);
    QPainterPath wave({60, 320});
    wave.cubicTo({200, 180}, {380, 460}, {600, 230});
    painter.drawPath(wave);
  });
}

}  // namespace batten::test
