// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/pdf_writer.h"

#include <QString>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <vector>

#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/exchange/model/cubic_outline.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/model/read_back.h"

namespace batten {
namespace {

constexpr double kPointsPerMm = 72.0 / kMillimetresPerInch;  // the unit of PDF is 1/72 inch
constexpr double kLargestPagePt = 14400.0;                   ///< Of PDF without UserUnit: 5080 mm.
constexpr int kPdfDecimals = 9;                              // of places that are no paths
constexpr int kPdfPathDecimals = 12;                         ///< As in SVG, for the curvature of short cubics.
constexpr double kPdfGridMm = 1e-12;                         // as many decimals

std::string pdfNumber(double value) { return roundedText(value, kPdfDecimals); }
std::string pdfPoint(const Vec2& p) {
  return roundedText(p.x(), kPdfPathDecimals) + " " + roundedText(p.y(), kPdfPathDecimals) + " ";
}

/// UTF-16 with its mark, in hexadecimal: how PDF keeps text beyond ASCII.
std::string pdfText(const std::string& utf8) {
  std::string text = "<FEFF";
  for (const QChar unit : QString::fromStdString(utf8))
    text += QString::number(uint(unit.unicode()), 16).rightJustified(4, QLatin1Char('0')).toUpper().toStdString();
  return text + ">";
}

struct Page {
  std::string content;
  std::vector<std::string> layers;
};

Result<Page> pageOf(const ExportDocument& document, const ExportSettings& settings, double unit,
                    const RunContext& context, PdfText& pdf) {
  const std::string scale = pdfNumber(kPointsPerMm / unit);
  Page page{"q\n" + scale + " 0 0 " + scale + " 0 0 cm\n" + pdfNumber(settings.strokeWidthMm) + " w 1 J 1 j\n", {}};
  const double tolerance = settings.toleranceMm.value_or(defaultTolerance(settings));
  std::size_t done = 0;
  for (const ExportCurve& curve : document.curves) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(done++) / static_cast<double>(document.curves.size()));
    if (page.layers.empty() || page.layers.back() != curve.layer) {
      if (!page.layers.empty()) page.content += "EMC\n";
      page.layers.push_back(curve.layer);
      page.content += "/OC /L" + std::to_string(page.layers.size()) + " BDC\n";
    }
    const auto outline =
        cubicOutline(curve, Eigen::Matrix2d::Identity(), Vec2::Zero(), {tolerance, kPdfGridMm}, context);
    if (!outline) return fail(outline.error());
    pdf.cubics += outline->cubics;
    pdf.largestErrorMm = std::max(pdf.largestErrorMm, outline->largestError);
    pdf.largestJump = std::max(pdf.largestJump, outline->largestJump);
    for (const CubicRun& run : outline->runs) {
      page.content += pdfPoint(run.start) + "m\n";
      for (const auto& c : run.cubics) page.content += pdfPoint(c[0]) + pdfPoint(c[1]) + pdfPoint(c[2]) + "c\n";
    }
    page.content += outline->closed ? "h S\n" : "S\n";
  }
  page.content += "EMC\nQ\n";
  return page;
}

/// The bytes of a file of numbered objects, the first of them the catalogue, the last one the information.
std::string fileOf(const std::vector<std::string>& objects) {
  std::string bytes = "%PDF-1.6\n%\xE2\xE3\xCF\xD3\n";
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    places.push_back(bytes.size());
    bytes += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::size_t table = bytes.size();
  const std::string count = std::to_string(objects.size() + 1);
  bytes += "xref\n0 " + count + "\n0000000000 65535 f \n";
  for (const std::size_t place : places) {
    const std::string digits = std::to_string(place);
    bytes += std::string(10 - std::min<std::size_t>(10, digits.size()), '0') + digits + " 00000 n \n";
  }
  return bytes + "trailer\n<< /Size " + count + " /Root 1 0 R /Info " + std::to_string(objects.size()) +
         " 0 R >>\nstartxref\n" + std::to_string(table) + "\n%%EOF\n";
}

using Cubics = std::vector<std::array<Vec2, 4>>;

/// The paths of a content stream, each up to its S.
Result<std::vector<Cubics>> pathsOf(const std::string& content) {
  std::vector<Cubics> paths(1);
  std::vector<double> numbers;
  Vec2 pen = Vec2::Zero();
  std::istringstream words(content);
  words.imbue(std::locale::classic());
  for (std::string word; words >> word;) {
    const auto at = [&](std::size_t i) { return Vec2(numbers[i], numbers[i + 1]); };
    if (word == "m" && numbers.size() == 2) {
      pen = at(0);
    } else if (word == "c" && numbers.size() == 6) {
      paths.back().push_back({pen, at(0), at(2), at(4)});
      pen = at(4);
    } else if (word == "S") {
      paths.emplace_back();
    } else if (word == "m" || word == "c") {
      return readsBackOtherwise("a path that is no chain of cubics");
    } else {
      const auto number = numbersIn(word);
      if (number.size() == 1) numbers.push_back(number[0]);
      if (number.empty()) numbers.clear();
      continue;
    }
    numbers.clear();
  }
  paths.pop_back();
  return paths;
}

}  // namespace

Result<PdfText> writePdf(const ExportDocument& document, const ExportSettings& settings, const RunContext& context) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  const double width = document.frame.lengthToModel(document.frame.widthPx) * kPointsPerMm;
  const double height = document.frame.lengthToModel(document.frame.heightPx) * kPointsPerMm;
  const double unit = std::max(1.0, std::ceil(std::max(width, height) / kLargestPagePt));
  const double left = document.frame.leftMm * kPointsPerMm / unit;
  const double bottom = document.frame.bottomMm * kPointsPerMm / unit;
  PdfText pdf;
  const auto page = pageOf(document, settings, unit, context, pdf);
  if (!page) return fail(page.error());

  constexpr std::size_t kFirstLayer = 5;  // objects: catalogue, pages, page, content, layers, information
  std::string list, names;
  for (std::size_t i = 0; i < page->layers.size(); ++i) {
    const std::string reference = std::to_string(kFirstLayer + i) + " 0 R ";
    list += reference;
    names += "/L" + std::to_string(i + 1) + " " + reference;
  }
  std::vector<std::string> objects = {
      "<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [ " + list + "] /D << /Order [ " + list + "] >> >> >>",
      "<< /Type /Pages /Kids [ 3 0 R ] /Count 1 >>",
      "<< /Type /Page /Parent 2 0 R /MediaBox [ " + pdfNumber(left) + " " + pdfNumber(bottom) + " " +
          pdfNumber(left + width / unit) + " " + pdfNumber(bottom + height / unit) + " ]" +
          (unit > 1.0 ? " /UserUnit " + pdfNumber(unit) : std::string()) +
          " /Contents 4 0 R /Resources << /Properties << " + names + ">> >> >>",
      "<< /Length " + std::to_string(page->content.size()) + " >>\nstream\n" + page->content + "\nendstream"};
  for (const std::string& layer : page->layers) objects.push_back("<< /Type /OCG /Name " + pdfText(layer) + " >>");
  objects.push_back("<< /Title " + pdfText(document.title) + " /Creator (Batten) /Producer (Batten) >>");
  pdf.bytes = fileOf(objects);
  return pdf;
}

Result<double> checkPdf(std::string_view bytes, const ExportDocument& document, const RunContext& context) {
  constexpr std::string_view kBegin = "stream\n", kEnd = "\nendstream";  // of the content, which is not compressed
  const auto begin = bytes.find(kBegin), end = bytes.find(kEnd);
  if (!bytes.starts_with("%PDF-") || begin == std::string_view::npos || end == std::string_view::npos || end < begin)
    return readsBackOtherwise("no content stream");
  const auto paths = pathsOf(std::string(bytes.substr(begin + kBegin.size(), end - begin - kBegin.size())));
  if (!paths) return fail(paths.error());
  if (paths->size() != document.curves.size()) return readsBackOtherwise("another number of curves");
  double most = 0.0;
  for (std::size_t i = 0; i < paths->size(); ++i) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(i) / static_cast<double>(paths->size()));
    if ((*paths)[i].empty()) return readsBackOtherwise("an empty path");
    most = std::max(most, distanceFromLine((*paths)[i], document.curves[i], context));
  }
  return most;
}

}  // namespace batten
