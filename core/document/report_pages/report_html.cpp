// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/document/report_pages/report_html.h"

#include <algorithm>

#include "core/base/number_text.h"
#include "core/exchange/model/file_text.h"

namespace batten {
namespace {

constexpr int kFigureDecimals = 4;                                   // of coordinates in mm
constexpr double kScaleBarLengthMm = 100.0, kScaleBarRoomMm = 10.0;  // of the scale bar

// of the page
constexpr const char* kStyle =
    "body{font:13px/1.45 system-ui,'Noto Sans','Liberation Sans',sans-serif;color:#1d1f21;background:#fff;"
    "max-width:1100px;margin:32px auto;padding:0 24px}\n"
    "h1{font-size:22px;margin:0 0 16px}h2{font-size:16px;margin:36px 0 10px}h3{font-size:13px;margin:0 0 2px}\n"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums}\n"
    "th,td{padding:4px 10px 4px 0;border-bottom:1px solid #dcdcd8;text-align:right;vertical-align:baseline}\n"
    "th{color:#6b6f74;font-weight:normal}th:first-child,td:first-child,.facts td{text-align:left}\n"
    ".facts td:first-child,p.mute{color:#6b6f74}.facts td{overflow-wrap:anywhere}.wide{overflow-x:auto}\n"
    "section{break-inside:avoid;padding:14px 0 6px;border-bottom:1px solid #dcdcd8}p{margin:0 0 6px}\n"
    "svg{display:block;max-width:none}.row{display:flex;flex-wrap:wrap;gap:4mm}\n"
    ".key{display:inline-block;width:22px;border-top:2px solid;margin:0 5px 3px 14px}\n"
    "pre{font-size:11px;overflow-x:auto}\n"
    "@media print{body{margin:0;padding:0;max-width:none}details{display:none}"
    ".wide{overflow-x:visible}.wide svg{max-width:100%;height:auto}}\n";

std::string decimalText(double value) { return roundedText(value, kFigureDecimals); }
std::string pointText(const Vec2& p) { return decimalText(p.x()) + " " + decimalText(p.y()); }

std::string pathText(const FigureStroke& stroke) {
  std::string data = "M";
  for (std::size_t i = 0; i < stroke.points.size(); ++i) {
    if (i == 1 || (i > 1 && stroke.isCubic && i % 3 == 1)) data += stroke.isCubic ? "C" : "L";
    data.append(pointText(stroke.points[i])).append(" ");
  }
  data.pop_back();
  std::string text = "<path d=\"" + data + "\" fill=\"none\" stroke=\"" + figureColour(stroke.ink);
  text.append("\" stroke-width=\"").append(decimalText(stroke.widthMm)).append("\"");
  if (stroke.isDashed) text += " stroke-dasharray=\"1.6 1\"";
  return text + " stroke-linecap=\"round\" stroke-linejoin=\"round\"/>\n";
}

std::string svgText(const Figure& figure, const std::string& label) {
  const std::string width = decimalText(figure.widthMm), height = decimalText(figure.heightMm);
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" + xmlText(label) +
                     "\" width=\"" + width + "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height +
                     "\" font-family=\"'Noto Sans','Liberation Sans',sans-serif\">\n";
  for (const FigureStroke& stroke : figure.strokes)
    if (stroke.points.size() > 1) text += pathText(stroke);
  for (const FigureText& one : figure.texts) {
    const char* anchor = one.anchor == FigureText::Anchor::Start    ? "start"
                         : one.anchor == FigureText::Anchor::Middle ? "middle"
                                                                    : "end";
    text += "<text x=\"" + decimalText(one.at.x()) + "\" y=\"" + decimalText(one.at.y()) + "\" font-size=\"" +
            decimalText(one.heightMm) + "\" text-anchor=\"" + anchor + "\" fill=\"" + figureColour(one.ink) + "\">" +
            xmlText(one.text) + "</text>\n";
  }
  return text + "</svg>\n";
}

std::string factTable(const std::vector<ReportContent::Fact>& facts) {
  std::string text = "<table class=\"facts\">\n";
  for (const auto& fact : facts)
    text += "<tr><td>" + xmlText(fact.name) + "</td><td>" + xmlText(fact.value) + "</td></tr>\n";
  return text + "</table>\n";
}

std::string fairnessTable(const ReportContent& content) {
  std::string text = "<div class=\"wide\"><table>\n<tr><th>Curve</th>";
  for (const std::string& column : content.columns) text += "<th>" + xmlText(column) + "</th>";
  text += "</tr>\n";
  for (const auto& curve : content.curves) {
    text += "<tr><td>" + xmlText(curve.name) + "</td>";
    for (const std::string& cell : curve.cells) text += "<td>" + xmlText(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string keyText(Ink ink, const char* what) {
  const std::string style = ink == Ink::Target ? "border-top-style:dashed;" : "";
  return "<span class=\"key\" style=\"" + style + "border-color:" + figureColour(ink) + "\"></span>" + what;
}

std::string sectionText(const ReportContent::CurveSection& curve) {
  std::string text = "<section><h3>" + xmlText(curve.name) + "</h3>\n<p class=\"mute\">" + xmlText(curve.fairing);
  for (const std::string& note : curve.notes) text += " " + xmlText(note);
  return text + "</p>\n<div class=\"row\">" + svgText(curve.comb, curve.name + ", curvature comb") +
         svgText(curve.radius, curve.name + ", radius over arc length") + "</div></section>\n";
}

Figure withBar(Figure drawing) {
  addScaleBar(drawing, {0.0, drawing.heightMm + 0.6 * kScaleBarRoomMm}, kScaleBarLengthMm);
  drawing.heightMm += kScaleBarRoomMm;
  drawing.widthMm = std::max(drawing.widthMm, kScaleBarLengthMm + 20.0);
  return drawing;
}

}  // namespace

std::string reportHtml(const ReportContent& content) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>" +
      xmlText(content.title) + "</title>\n<style>\n" + kStyle + "</style></head><body>\n<h1>" + xmlText(content.title) +
      "</h1>\n" + factTable(content.facts);
  text +=
      "<h2>Drawing, 1:1</h2>\n<p class=\"mute\">Printed at 100 %, the bar is 100 mm long, "
      "unless the drawing is wider than the sheet and was reduced to fit. " +
      keyText(Ink::Sketched, "sketched") + keyText(Ink::Faired, "faired") + "</p>\n<div class=\"wide\">" +
      svgText(withBar(content.drawing), "Drawing") + "</div>\n";
  text +=
      "<h2>Fairness and deviations</h2>\n<p class=\"mute\">An arrow leads from the sketched to the faired curve. "
      "Variation is the integral of the squared slope of the curvature, times the cube of the length; rms, 95 % "
      "and largest are distances of the scan's edge points from the curve; moved is what fairing did.</p>\n" +
      fairnessTable(content);
  text += "<h2>Curves</h2>\n<p class=\"mute\">Curvature comb, and radius over arc length. " +
          keyText(Ink::Sketched, "sketched") + keyText(Ink::Faired, "faired") + keyText(Ink::Target, "target") +
          "</p>\n";
  for (const auto& curve : content.curves) text += sectionText(curve);
  text += "<h2>Recipe</h2>\n";
  text += content.settings.empty() ? "<p>All settings have their default values.</p>\n" : factTable(content.settings);
  text += "<details><summary>The whole recipe</summary><pre>";
  // Its line ends are kept; xmlText() would make blanks of them.
  for (std::size_t from = 0; from < content.recipeJson.size();) {
    const std::size_t to = std::min(content.recipeJson.find('\n', from), content.recipeJson.size());
    text.append(xmlText(content.recipeJson.substr(from, to - from))).append("\n");
    from = to + 1;
  }
  return text + "</pre></details>\n</body></html>\n";
}

}  // namespace batten
