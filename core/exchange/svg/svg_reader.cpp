// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg/svg_reader.h"

#include <QByteArray>
#include <QXmlStreamReader>
#include <cmath>
#include <optional>

#include "core/exchange/model/export_check.h"
#include "core/exchange/model/file_text.h"

namespace batten {
namespace {

constexpr double kMostPixels = 1e6;  ///< Of a side; a page beyond that is damage.

tl::unexpected<Error> unreadable(const std::string& what) {
  return fail(ErrorCode::BadParameter, "The SVG cannot be read: " + withoutFullStop(what) + ".");
}

/// One element of the file and its attributes.
class Element {
 public:
  explicit Element(const QXmlStreamReader& xml) : name_(xml.name().toString()), attributes_(xml.attributes()) {}
  bool is(const char* name) const { return name_ == QLatin1String(name); }
  std::string text(const char* name) const { return attributes_.value(QLatin1String(name)).toString().toStdString(); }
  std::vector<double> numbers(const char* name) const { return numbersIn(text(name)); }
  std::optional<double> number(const char* name) const {
    const std::vector<double> all = numbers(name);
    return all.size() == 1 && std::isfinite(all[0]) ? std::optional(all[0]) : std::nullopt;
  }

 private:
  QString name_;
  QXmlStreamAttributes attributes_;
};

Result<NurbsCurve> splineOfPiece(const Element& piece) {
  const auto degree = piece.number("degree");
  const std::vector<double> coordinates = piece.numbers("control-points");
  if (!degree || *degree != std::floor(*degree) || *degree < 1 || *degree > 7 || coordinates.size() % 2 != 0)
    return fail(ErrorCode::BadParameter, "a curve of its metadata is no B-spline");
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < coordinates.size(); i += 2) points.emplace_back(coordinates[i], coordinates[i + 1]);
  return NurbsCurve::make(static_cast<int>(*degree), piece.numbers("knots"), std::move(points),
                          piece.numbers("weights"));
}

Result<void> take(const Element& element, std::vector<double>& page, ExportDocument& document) {
  if (element.is("svg")) page = {element.number("width").value_or(0.0), element.number("height").value_or(0.0)};
  if (element.is("curves")) {
    const auto scale = element.number("mm-per-px");
    if (!scale || !(*scale > 0.0)) return unreadable("its metadata states no scale");
    document.frame.mmPerPx = *scale;
    if (const auto origin = element.numbers("origin-mm"); origin.size() == 2) {
      document.frame.leftMm = origin[0];
      document.frame.bottomMm = origin[1];
    }
    document.imageSha256 = element.text("image-sha256");
  } else if (element.is("curve")) {
    ExportCurve& curve = document.curves.emplace_back();
    curve.id = element.text("id");
    curve.closed = element.text("closed") == "true";
    curve.name = element.text("name");
    if (const std::string layer = element.text("layer"); !layer.empty()) curve.layer = layer;
  } else if (element.is("piece")) {
    if (document.curves.empty()) return unreadable("its metadata is out of order");
    auto curve = splineOfPiece(element);
    if (!curve) return unreadable(curve.error().message);
    document.curves.back().pieces.push_back({std::move(*curve), element.text("name")});
  }
  return {};
}

}  // namespace

Result<ExportDocument> readSvg(std::string_view text) {
  QXmlStreamReader xml(QByteArray::fromRawData(text.data(), static_cast<qsizetype>(text.size())));
  ExportDocument document;
  std::vector<double> page;
  while (!xml.atEnd()) {
    const auto token = xml.readNext();
    if (token == QXmlStreamReader::StartElement && xml.name() == QLatin1String("title")) {
      document.title = xml.readElementText(QXmlStreamReader::SkipChildElements).toStdString();
    } else if (token == QXmlStreamReader::StartElement) {
      if (auto taken = take(Element(xml), page, document); !taken) return fail(taken.error());
    }
  }
  if (xml.hasError()) return unreadable("it is damaged (" + xml.errorString().toStdString() + ")");
  if (document.curves.empty()) return unreadable("it holds no curves of Batten");
  if (page.size() != 2) return unreadable("its page has no size");
  const double width = page[0] / document.frame.mmPerPx, height = page[1] / document.frame.mmPerPx;
  if (!(width >= 0.5 && width < kMostPixels && height >= 0.5 && height < kMostPixels))
    return unreadable("its page has no size");
  document.frame.widthPx = static_cast<int>(std::lround(width));
  document.frame.heightPx = static_cast<int>(std::lround(height));
  if (auto problem = exportProblem(document)) return unreadable(problem->message);
  return document;
}

}  // namespace batten
