// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/report_pdf.h"

#include <QBuffer>
#include <QGuiApplication>
#include <algorithm>
#include <cmath>

#include "core/base/number_text.h"
#include "core/document/report_pages/page_painter.h"

namespace batten {
namespace {

constexpr double kMarginMm = 12.0, kFootMm = 8.0, kBarRoomMm = 9.0, kBarLengthMm = 100.0;  // of the sheet
constexpr double kOverlapMm = 10.0, kMarkMm = 4.0;             // of sheets that are put together
constexpr int kMostSheets = 40;                                // of a drawing: limits the paper
constexpr double kTextMm = 3.0, kRowMm = 5.2, kSmallMm = 2.5;  // sizes of fonts and rows
constexpr double kNameWidthMm = 24.0, kFactNameMm = 34.0;      // columns

/// Sheets of one orientation for the drawing.
struct SheetPlan {
  bool isLandscape = false;
  int columns = 1, rows = 1;
  Vec2 area = Vec2::Zero();  ///< [mm] Of the drawing on a sheet, the overlap included.
  int count() const { return columns * rows; }
};

SheetPlan planSheets(const Figure& drawing, const Vec2& paper, bool isLandscape) {
  SheetPlan plan;
  plan.isLandscape = isLandscape;
  const double head = kMarginMm + 2.0 * kTextMm;
  plan.area = Vec2(paper.x() - 2 * kMarginMm, paper.y() - head - kFootMm - kMarginMm - kBarRoomMm);
  const auto needed = [](double length, double room) {
    return length <= room ? 1 : 1 + static_cast<int>(std::ceil((length - room) / (room - kOverlapMm)));
  };
  plan.columns = needed(drawing.widthMm, plan.area.x());
  plan.rows = needed(drawing.heightMm, plan.area.y());
  return plan;
}

class Pages {
 public:
  Pages(const ReportContent& content, PagePainter& page, const RunContext& context)
      : content_(content), page_(page), context_(context) {}

  Result<void> paint() {
    head();
    facts(content_.facts);
    const Vec2 paper(page_.widthMm(), page_.heightMm());
    const double room = bottom() - y_ - kBarRoomMm - 2 * kTextMm;
    const Figure& drawing = content_.drawing;
    if (drawing.widthMm <= paper.x() - 2 * kMarginMm && drawing.heightMm <= room) {
      y_ += kTextMm;
      title("Drawing, 1:1");
      page_.figure(drawing, {0.5 * (paper.x() - drawing.widthMm), y_});
      y_ += drawing.heightMm + 0.7 * kBarRoomMm;
      bar(y_);
      y_ += kTextMm;
    } else {
      overview(paper, bottom() - y_ - 14.0);
      if (auto done = sheets(paper); !done) return done;
    }
    if (auto done = table(); !done) return done;
    if (auto done = curves(); !done) return done;
    settings();
    foot();
    return {};
  }

 private:
  double bottom() const { return page_.heightMm() - kMarginMm - kFootMm; }
  double width() const { return page_.widthMm() - 2 * kMarginMm; }

  void head() {
    y_ = kMarginMm + 5.0;
    page_.text({kMarginMm, y_}, content_.title, 5.0, Ink::Text, {}, true);
    y_ += 7.0;
  }
  void foot() {
    const double y = page_.heightMm() - kMarginMm;
    page_.line({kMarginMm, y - 4.2}, {page_.widthMm() - kMarginMm, y - 4.2}, Ink::Grid, 0.15);
    page_.text({kMarginMm, y}, content_.title, kSmallMm, Ink::Mute);
    page_.text({page_.widthMm() - kMarginMm, y}, std::to_string(page_.page()), kSmallMm, Ink::Mute,
               FigureText::Anchor::End);
  }
  void newPage(bool isLandscape = false) {
    foot();
    page_.newPage(isLandscape);
    y_ = kMarginMm + kTextMm;
  }
  /// A new page where less than so much is left.
  void need(double mm) {
    if (y_ + mm > bottom()) newPage();
  }
  void title(const std::string& words) {
    y_ += 4.0;
    page_.text({kMarginMm, y_}, words, 3.8, Ink::Text, {}, true);
    y_ += 4.0;
  }
  void facts(const std::vector<ReportContent::Fact>& list) {
    for (const auto& fact : list) {
      need(kRowMm);
      page_.text({kMarginMm, y_ + kTextMm}, fact.name, kTextMm, Ink::Mute);
      const double below =
          page_.paragraph({kMarginMm + kFactNameMm, y_ + 0.2}, width() - kFactNameMm, fact.value, kTextMm, Ink::Text);
      y_ = std::max(y_ + kRowMm, below + 1.0);
    }
  }
  void bar(double y) {
    Figure figure;
    addScaleBar(figure, {0.0, 0.0}, kBarLengthMm);
    figure.texts.push_back({{kBarLengthMm + 22.0, 0.0},
                            "Print at 100 %, not fitted to the page.",
                            FigureText::Anchor::Start,
                            Ink::Mute,
                            kSmallMm});
    page_.figure(figure, {kMarginMm, y});
  }

  /// The whole drawing on the first page, where it does not fit in its true size.
  void overview(const Vec2& paper, double roomMm) {
    const Figure& drawing = content_.drawing;
    const double scale = std::min((paper.x() - 2 * kMarginMm) / drawing.widthMm, roomMm / drawing.heightMm);
    y_ += kTextMm;
    title("Drawing, reduced to " + significantText(100.0 * scale, 3) + " %");
    page_.figure(drawing, {0.5 * (paper.x() - scale * drawing.widthMm), y_}, scale);
  }

  Result<void> sheets(const Vec2& upright) {
    const SheetPlan standing = planSheets(content_.drawing, upright, false);
    const SheetPlan lying = planSheets(content_.drawing, {upright.y(), upright.x()}, true);
    SheetPlan plan = lying.count() < standing.count() ? lying : standing;
    double scale = 1.0;
    if (plan.count() > kMostSheets) {
      const bool isWide = content_.drawing.widthMm > content_.drawing.heightMm;
      plan = isWide ? lying : standing;
      plan.columns = plan.rows = 1;
      scale = std::min(plan.area.x() / content_.drawing.widthMm, plan.area.y() / content_.drawing.heightMm);
    }
    for (int row = 0; row < plan.rows; ++row) {
      for (int column = 0; column < plan.columns; ++column) {
        if (context_.isCancelled()) return cancelled();
        sheet(plan, row, column, scale);
      }
    }
    newPage();
    return {};
  }

  void sheet(const SheetPlan& plan, int row, int column, double scale) {
    newPage(plan.isLandscape);
    std::string words = scale < 1.0 ? "Drawing, reduced to " + significantText(100.0 * scale, 3) +
                                          " %: at 1:1 it would take too many sheets"
                                    : "Drawing, 1:1";
    if (plan.count() > 1) {
      words += ", sheet " + std::to_string(row * plan.columns + column + 1) + " of " + std::to_string(plan.count()) +
               " (row " + std::to_string(row + 1) + ", column " + std::to_string(column + 1) + ")";
    }
    page_.text({kMarginMm, y_}, words, kTextMm, Ink::Text, {}, true);
    const Vec2 corner(kMarginMm, kMarginMm + 2.0 * kTextMm);
    const Vec2 step = plan.area - Vec2(kOverlapMm, kOverlapMm);
    const Vec2 from(column * step.x(), row * step.y());
    page_.clip(corner, plan.area);
    page_.figure(content_.drawing, corner - from, scale);
    page_.unclip();
    if (plan.count() > 1) {
      marks(corner, plan.area);
    }
    bar(corner.y() + plan.area.y() + 0.7 * kBarRoomMm);
  }

  /// Crosses at the corners of what the sheets have in common: neighbours fit where these lie on each other.
  void marks(const Vec2& corner, const Vec2& area) {
    for (const double x : {0.5 * kOverlapMm, area.x() - 0.5 * kOverlapMm}) {
      for (const double y : {0.5 * kOverlapMm, area.y() - 0.5 * kOverlapMm}) {
        const Vec2 at = corner + Vec2(x, y);
        page_.line(at - Vec2(0.5 * kMarkMm, 0), at + Vec2(0.5 * kMarkMm, 0), Ink::Mute, 0.1);
        page_.line(at - Vec2(0, 0.5 * kMarkMm), at + Vec2(0, 0.5 * kMarkMm), Ink::Mute, 0.1);
      }
    }
  }

  double columnWidth() const { return (width() - kNameWidthMm) / static_cast<double>(content_.columns.size()); }

  void tableHead() {
    double most = y_;
    for (std::size_t i = 0; i < content_.columns.size(); ++i) {
      const double left = kMarginMm + kNameWidthMm + static_cast<double>(i) * columnWidth();
      most = std::max(most,
                      page_.paragraph({left, y_}, columnWidth() - 1.5, content_.columns[i], kSmallMm - 0.1, Ink::Mute));
    }
    y_ = most + 0.8;
    page_.line({kMarginMm, y_}, {kMarginMm + width(), y_}, Ink::Mute, 0.15);
    y_ += 1.0;
  }

  Result<void> table() {
    need(30.0);
    title("Fairness and deviations");
    y_ = page_.paragraph({kMarginMm, y_}, width(),
                         "An arrow leads from the sketched to the faired curve. Variation is the integral of the "
                         "squared slope of the curvature, times the cube of the length. Rms, 95 % and largest are "
                         "distances of the scan's edge points from the curve; moved is what fairing did.",
                         kSmallMm, Ink::Mute) +
         2.0;
    tableHead();
    for (const auto& curve : content_.curves) {
      if (context_.isCancelled()) return cancelled();
      if (y_ + kRowMm > bottom()) {
        newPage();
        tableHead();
      }
      double below = page_.paragraph({kMarginMm, y_}, kNameWidthMm - 1.0, curve.name, kSmallMm, Ink::Text);
      for (std::size_t i = 0; i < curve.cells.size(); ++i) {
        const double left = kMarginMm + kNameWidthMm + static_cast<double>(i) * columnWidth();
        below = std::max(below, page_.paragraph({left, y_}, columnWidth() - 1.0, curve.cells[i], kSmallMm, Ink::Text));
      }
      y_ = below + 0.7;
      page_.line({kMarginMm, y_}, {kMarginMm + width(), y_}, Ink::Grid, 0.1);
      y_ += 0.9;
    }
    return {};
  }

  void key(double x, Ink ink, const std::string& words) {
    Figure figure;
    figure.strokes.push_back({{{0, 0}, {7, 0}}, false, ink == Ink::Target, ink, 0.3});
    page_.figure(figure, {x, y_ - 0.9});
    page_.text({x + 8.5, y_}, words, kSmallMm, Ink::Mute);
  }

  Result<void> curves() {
    const double figures = content_.curves.front().comb.heightMm;
    need(figures + 24.0);
    y_ += 4.0;
    title("Curves");
    key(kMarginMm, Ink::Sketched, "sketched");
    key(kMarginMm + 26.0, Ink::Faired, "faired");
    key(kMarginMm + 49.0, Ink::Target, "target");
    y_ += 4.0;
    for (std::size_t i = 0; i < content_.curves.size(); ++i) {
      if (context_.isCancelled()) return cancelled();
      curve(content_.curves[i]);
      context_.report(static_cast<double>(i + 1) / static_cast<double>(content_.curves.size()));
    }
    return {};
  }

  void curve(const ReportContent::CurveSection& section) {
    need(section.comb.heightMm + 14.0);
    page_.text({kMarginMm, y_ + kTextMm}, section.name, kTextMm, Ink::Text, {}, true);
    y_ += 4.4;
    std::string words = section.fairing;
    for (const std::string& note : section.notes) words += " " + note;
    y_ = page_.paragraph({kMarginMm, y_}, width(), words, kSmallMm, Ink::Mute) + 1.0;
    const double total = section.comb.widthMm + section.radius.widthMm + 4.0;
    const double scale = std::min(1.0, width() / total);
    page_.figure(section.comb, {kMarginMm, y_}, scale);
    page_.figure(section.radius, {kMarginMm + scale * (section.comb.widthMm + 4.0), y_}, scale);
    y_ += scale * section.comb.heightMm + 3.0;
  }

  void settings() {
    need(24.0);
    y_ += 4.0;
    title("Recipe");
    if (content_.settings.empty()) {
      page_.text({kMarginMm, y_ + kTextMm}, "All settings have their default values.", kTextMm, Ink::Text);
      y_ += kRowMm;
    }
    for (const auto& fact : content_.settings) {
      need(kRowMm);
      page_.text({kMarginMm, y_ + kTextMm}, fact.name, kTextMm, Ink::Mute);
      y_ = std::max(y_ + kRowMm,
                    page_.paragraph({kMarginMm + 80.0, y_ + 0.2}, width() - 80.0, fact.value, kTextMm, Ink::Text));
    }
    need(kRowMm);
    page_.text({kMarginMm, y_ + kTextMm}, "The whole recipe is attached to this file as recipe.json.", kSmallMm,
               Ink::Mute);
  }

  const ReportContent& content_;
  PagePainter& page_;
  const RunContext& context_;
  double y_ = 0.0;
};

}  // namespace

Result<std::string> reportPdf(const ReportContent& content, ReportPaper paper, const RunContext& context) {
  const auto failed = [] {
    return fail(ErrorCode::CannotWrite, "The pages of the report could not be made. Write it as .html.");
  };
  if (content.curves.empty())
    return fail(ErrorCode::NoCurve, "There is no curve to report on. Include at least one curve.");
  // Without one, Qt ends the program as soon as it is asked for a font.
  if (qobject_cast<QGuiApplication*>(QCoreApplication::instance()) == nullptr) return failed();
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  {
    QPdfWriter writer(&buffer);
    writer.setTitle(QString::fromStdString(content.title));
    writer.setCreator(QStringLiteral("Batten"));
    writer.addFileAttachment(QStringLiteral("recipe.json"), QByteArray::fromStdString(content.recipeJson),
                             QStringLiteral("application/json"));
    PagePainter page(writer, paper, false);
    if (!page.isActive()) return failed();
    if (auto painted = Pages(content, page, context).paint(); !painted) return fail(painted.error());
    if (!page.end()) return failed();
  }
  if (!bytes.startsWith("%PDF-") || !bytes.trimmed().endsWith("%%EOF")) return failed();
  return bytes.toStdString();
}

}  // namespace batten
