// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/page_painter.h"

#include <QFontDatabase>
#include <QFontMetricsF>
#include <QPageLayout>
#include <QPainterPath>
#include <QTextLayout>
#include <algorithm>
#include <cmath>

#include "core/base/conventions.h"

namespace batten {
namespace {

/// [1/inch] Units of the device: fonts have a whole number of them.
constexpr int kResolution = 2540;
constexpr double kLeading = 1.35;  // line height in font sizes

QString familyOfPages() {
  const QStringList known = QFontDatabase::families();
  for (const char* wanted : {"Inter", "Noto Sans", "Liberation Sans", "DejaVu Sans"})
    if (known.contains(QLatin1String(wanted))) return QLatin1String(wanted);
  return {};
}

QPainterPath pathOf(const FigureStroke& stroke, const auto& place) {
  QPainterPath path(place(stroke.points.front()));
  const auto& p = stroke.points;
  if (stroke.isCubic) {
    for (std::size_t i = 1; i + 2 < p.size(); i += 3) path.cubicTo(place(p[i]), place(p[i + 1]), place(p[i + 2]));
  } else {
    for (std::size_t i = 1; i < p.size(); ++i) path.lineTo(place(p[i]));
  }
  return path;
}

}  // namespace

PagePainter::PagePainter(QPdfWriter& writer, ReportPaper paper, bool isLandscape)
    : writer_(writer), paper_(paper), unit_(kResolution / kMillimetresPerInch) {
  writer_.setResolution(kResolution);
  layOut(isLandscape);
  painter_.begin(&writer_);
}

void PagePainter::layOut(bool isLandscape) {
  const QPageSize size(paper_ == ReportPaper::A4 ? QPageSize::A4 : QPageSize::Letter);
  QPageLayout layout(size, isLandscape ? QPageLayout::Landscape : QPageLayout::Portrait, QMarginsF(0, 0, 0, 0),
                     QPageLayout::Millimeter, QMarginsF(0, 0, 0, 0));
  layout.setMode(QPageLayout::FullPageMode);
  writer_.setPageLayout(layout);
  const QSizeF mm = layout.fullRect(QPageLayout::Millimeter).size();
  widthMm_ = mm.width();
  heightMm_ = mm.height();
}

void PagePainter::newPage(bool isLandscape) {
  layOut(isLandscape);
  writer_.newPage();
  ++page_;
}

QFont PagePainter::font(double heightMm, bool bold) const {
  static const QString family = familyOfPages();
  QFont font;
  if (!family.isEmpty()) font.setFamily(family);
  font.setPixelSize(std::max(1, static_cast<int>(std::lround(heightMm * unit_))));
  font.setBold(bold);
  // Inter draws "1:1", "2 x 3" and "-1" with glyphs that stand for no letter: text taken out of the PDF would lack
  // them.
  font.setStyleStrategy(QFont::PreferNoShaping);
  return font;
}

void PagePainter::text(const Vec2& at, const std::string& utf8, double heightMm, Ink ink, FigureText::Anchor anchor,
                       bool bold) {
  const QFont own = font(heightMm, bold);
  const QString words = QString::fromStdString(utf8);
  const double width = QFontMetricsF(own, &writer_).horizontalAdvance(words);
  const double back = anchor == FigureText::Anchor::Start ? 0.0 : anchor == FigureText::Anchor::Middle ? 0.5 : 1.0;
  painter_.setFont(own);
  painter_.setPen(QColor(QLatin1String(figureColour(ink))));
  painter_.drawText(device(at) - QPointF(back * width, 0), words);
}

double PagePainter::paragraph(const Vec2& at, double widthMm, const std::string& utf8, double heightMm, Ink ink) {
  QTextLayout layout(QString::fromStdString(utf8), font(heightMm, false), &writer_);
  QTextOption option;
  option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
  layout.setTextOption(option);
  painter_.setPen(QColor(QLatin1String(figureColour(ink))));
  double down = 0.0;
  layout.beginLayout();
  for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
    line.setLineWidth(widthMm * unit_);
    line.setPosition({0.0, down * unit_});
    down += kLeading * heightMm;
  }
  layout.endLayout();
  layout.draw(&painter_, device(at));
  return at.y() + down;
}

void PagePainter::line(const Vec2& from, const Vec2& to, Ink ink, double widthMm) {
  painter_.setPen(QPen(QColor(QLatin1String(figureColour(ink))), widthMm * unit_));
  painter_.drawLine(QLineF(device(from), device(to)));
}

void PagePainter::figure(const Figure& figure, const Vec2& at, double scale) {
  const auto place = [&](const Vec2& p) { return device(at + scale * p); };
  painter_.setBrush(Qt::NoBrush);
  for (const FigureStroke& stroke : figure.strokes) {
    if (stroke.points.size() < 2) continue;
    QPen pen(QColor(QLatin1String(figureColour(stroke.ink))), stroke.widthMm * unit_, Qt::SolidLine, Qt::RoundCap,
             Qt::RoundJoin);
    // In widths of the line.
    if (stroke.isDashed) pen.setDashPattern({1.6 / stroke.widthMm, 1.0 / stroke.widthMm});
    painter_.setPen(pen);
    painter_.drawPath(pathOf(stroke, place));
  }
  for (const FigureText& one : figure.texts) text(at + scale * one.at, one.text, one.heightMm, one.ink, one.anchor);
}

void PagePainter::clip(const Vec2& at, const Vec2& sizeMm) {
  painter_.save();
  painter_.setClipRect(QRectF(device(at), QSizeF(sizeMm.x() * unit_, sizeMm.y() * unit_)));
}

void PagePainter::unclip() { painter_.restore(); }

}  // namespace batten
