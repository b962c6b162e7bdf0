// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPainter>
#include <QPdfWriter>
#include <QString>
#include <string>

#include "core/document/report_pages/figure.h"
#include "core/document/report_pages/report_pdf.h"

namespace batten {

/// Paints on the pages of a PDF in mm from the upper left corner of the paper.
class PagePainter {
 public:
  /// The first page is upright or lies, as said; the others as they are asked for.
  PagePainter(QPdfWriter&, ReportPaper, bool isLandscape);
  void newPage(bool isLandscape);
  int page() const { return page_; }
  double widthMm() const { return widthMm_; }
  double heightMm() const { return heightMm_; }
  bool isActive() const { return painter_.isActive(); }
  bool end() { return painter_.end(); }

  void text(const Vec2& at, const std::string& utf8, double heightMm, Ink, FigureText::Anchor = {}, bool bold = false);
  /// Lines of text within a width; long words are broken. @return how far down the next line would stand.
  double paragraph(const Vec2& at, double widthMm, const std::string& utf8, double heightMm, Ink);
  void line(const Vec2& from, const Vec2& to, Ink, double widthMm);
  /// The figure with its upper left corner at a place, `scale` times as large.
  void figure(const Figure&, const Vec2& at, double scale = 1.0);
  /// Only what lies inside is painted until unclip().
  void clip(const Vec2& at, const Vec2& sizeMm);
  void unclip();

 private:
  QPointF device(const Vec2& mm) const { return {mm.x() * unit_, mm.y() * unit_}; }
  QFont font(double heightMm, bool bold) const;
  void layOut(bool isLandscape);

  QPdfWriter& writer_;
  ReportPaper paper_;
  QPainter painter_;
  double unit_;  ///< Units of the device in a mm.
  double widthMm_ = 0.0, heightMm_ = 0.0;
  int page_ = 1;
};

}  // namespace batten
