// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg/svg_check.h"

#include <QByteArray>
#include <QXmlStreamReader>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/exchange/model/cubic_outline.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/model/read_back.h"
#include "core/exchange/model/width_distance.h"
#include "core/exchange/svg/svg_writer.h"

namespace batten {
namespace {

struct ReadPiece {
  int degree = 0;
  std::vector<double> knots, coordinates, weights;
};
struct ReadSvg {
  std::vector<std::vector<ReadPiece>> curves;
  std::vector<QByteArray> paths;
  std::vector<std::pair<std::string, QByteArray>> outlines;  ///< Of the curve with this id.
  double unitsPerMm = 1.0;
};

Result<ReadSvg> parsed(std::string_view text) {
  QXmlStreamReader xml(QByteArray::fromRawData(text.data(), static_cast<qsizetype>(text.size())));
  ReadSvg svg;
  while (!xml.atEnd()) {
    if (xml.readNext() != QXmlStreamReader::StartElement) continue;
    const auto attributes = xml.attributes();
    const auto value = [&](const char* name) { return attributes.value(QLatin1String(name)).toLatin1(); };
    if (xml.name() == QLatin1String("svg")) {
      const auto width = numbersIn(value("width").toStdString()), box = numbersIn(value("viewBox").toStdString());
      if (width.size() != 1 || box.size() != 4 || !(width[0] > 0.0) || !(box[2] > 0.0))
        return readsBackOtherwise("another size of the page");
      svg.unitsPerMm = box[2] / width[0];
    } else if (xml.name() == QLatin1String("curve")) {
      svg.curves.emplace_back();
    } else if (xml.name() == QLatin1String("piece")) {
      if (svg.curves.empty()) return readsBackOtherwise("a piece outside of a curve");
      svg.curves.back().push_back({value("degree").toInt(), numbersIn(value("knots").toStdString()),
                                   numbersIn(value("control-points").toStdString()),
                                   numbersIn(value("weights").toStdString())});
    } else if (xml.name() == QLatin1String("path")) {
      const auto widthOf = attributes.value(QStringLiteral("urn:batten:curves:1"), QLatin1String(kWidthOf));
      if (widthOf.isEmpty())
        svg.paths.push_back(value("d"));
      else
        svg.outlines.emplace_back(widthOf.toString().toStdString(), value("d"));
    }
  }
  if (xml.hasError()) return readsBackOtherwise(xml.errorString().toStdString());
  return svg;
}

bool isSame(const ReadPiece& read, const NurbsCurve& curve) {
  const auto points = curve.controlPoints();
  if (read.degree != curve.degree() || read.coordinates.size() != 2 * points.size()) return false;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (read.coordinates[2 * i] != points[i].x() || read.coordinates[2 * i + 1] != points[i].y()) return false;
  return std::ranges::equal(read.knots, curve.knots()) && std::ranges::equal(read.weights, curve.weights());
}

/// A path in the model frame.
struct ReadPath {
  std::vector<std::array<Vec2, 4>> cubics;
  bool closes = false;
};

Result<ReadPath> pathOf(const QByteArray& data, const PageFrame& frame, double unitsPerMm, bool hasLoops = false) {
  ReadPath path;
  Vec2 pen = Vec2::Zero();
  qsizetype at = 0;
  while (at < data.size()) {
    const char command = data[at++];
    if (command == ' ') continue;
    if (path.closes && !hasLoops) return readsBackOtherwise("a path that goes on behind its end");
    qsizetype end = at;
    while (end < data.size() && std::isalpha(static_cast<unsigned char>(data[end])) == 0) ++end;
    const std::vector<double> n = numbersIn(data.mid(at, end - at).toStdString());
    at = end;
    const auto model = [&](std::size_t i) {
      return Vec2(frame.leftMm + n[i] / unitsPerMm,
                  frame.bottomMm + frame.lengthToModel(frame.heightPx) - n[i + 1] / unitsPerMm);
    };
    if (command == 'M' && n.size() == 2) {
      pen = model(0);
    } else if (command == 'C' && n.size() == 6) {
      path.cubics.push_back({pen, model(0), model(2), model(4)});
      pen = model(4);
    } else if (command == 'Z' && n.empty()) {
      path.closes = true;
    } else {
      return readsBackOtherwise("a path that is no chain of cubics");
    }
  }
  if (path.cubics.empty()) return readsBackOtherwise("an empty path");
  return path;
}

/// Every outline belongs to a curve with a width and lies around it.
Result<void> checkOutlines(const ReadSvg& svg, const ExportDocument& document, const RunContext& context,
                           SvgCheck& check) {
  for (const auto& outline : svg.outlines) {
    const auto& id = outline.first;
    const auto& data = outline.second;
    if (context.isCancelled()) return cancelled();
    const auto curve = std::find_if(document.curves.begin(), document.curves.end(),
                                    [&](const ExportCurve& one) { return one.id == id; });
    if (curve == document.curves.end()) return readsBackOtherwise("the outline of another curve");
    const auto path = pathOf(data, document.frame, svg.unitsPerMm, true);
    if (!path) return fail(path.error());
    const double off = distanceFromWidth(path->cubics, *curve, context);
    if (!std::isfinite(off)) return readsBackOtherwise("an outline that is no stroke's");
    check.largestWidthErrorMm = std::max(check.largestWidthErrorMm, off);
    ++check.outlines;
  }
  return {};
}

}  // namespace

Result<SvgCheck> checkSvg(std::string_view text, const ExportDocument& document, const RunContext& context) {
  auto svg = parsed(text);
  if (!svg) return fail(std::move(svg).error());
  if (svg->paths.size() != document.curves.size() || svg->curves.size() != document.curves.size())
    return readsBackOtherwise("another number of curves");
  SvgCheck check;
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(i) / static_cast<double>(document.curves.size()));
    const ExportCurve& curve = document.curves[i];
    if (svg->curves[i].size() != curve.pieces.size())
      return readsBackOtherwise("another number of pieces in " + curve.id);
    for (std::size_t k = 0; k < curve.pieces.size(); ++k)
      if (!isSame(svg->curves[i][k], curve.pieces[k].curve))
        return readsBackOtherwise("another B-spline in " + curve.id);
    const auto path = pathOf(svg->paths[i], document.frame, svg->unitsPerMm);
    if (!path) return fail(path.error());
    if (path->closes != curve.closed) return readsBackOtherwise("a path closed otherwise than " + curve.id);
    check.largestErrorMm = std::max(check.largestErrorMm, distanceFromLine(path->cubics, curve, context));
    check.cubics += static_cast<int>(path->cubics.size());
    ++check.curves;
  }
  if (auto outlines = checkOutlines(*svg, document, context, check); !outlines) return fail(outlines.error());
  return check;
}

}  // namespace batten
