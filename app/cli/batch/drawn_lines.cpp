// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/batch/drawn_lines.h"

#include <QByteArray>
#include <QXmlStreamReader>
#include <cctype>

#include "core/base/regular_file.h"
#include "core/curve/arc_length.h"
#include "core/curve/cubic.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/text/curve_json.h"

namespace batten::cli {
namespace {

constexpr int kSamplesPerPiece = 64;  // a piece from corner to corner, on a picture of a few hundred pixels
constexpr int kSamplesPerCubic = 4;   // of an SVG

DrawnLines linesOfJson(const std::string& text) {
  DrawnLines drawn;
  const auto document = readCurveJson(text);
  if (!document) return drawn;
  const PageFrame& frame = document->frame;
  if (frame.widthPx <= 0 || frame.heightPx <= 0) return drawn;
  drawn.aspect = static_cast<double>(frame.widthPx) / frame.heightPx;
  for (const ExportCurve& curve : document->curves) {
    for (const ExportPiece& piece : curve.pieces) {
      std::vector<Vec2> line;
      for (const CurveSample& sample : sampleByArcLength(piece.curve, kSamplesPerPiece)) {
        const Vec2 px = frame.pointToImage(sample.point);
        line.emplace_back(px.x() / frame.widthPx, px.y() / frame.heightPx);
      }
      drawn.lines.push_back(std::move(line));
    }
  }
  return drawn;
}

/// The polylines of a path of absolute moves, lines and cubics, as our writer makes them.
void addPath(const QByteArray& path, const std::vector<double>& box, DrawnLines& drawn) {
  Vec2 pen(0.0, 0.0);
  const auto toPage = [&](const Vec2& p) { return Vec2((p.x() - box[0]) / box[2], (p.y() - box[1]) / box[3]); };
  for (qsizetype at = 0; at < path.size();) {
    const char command = path[at++];
    qsizetype end = at;
    while (end < path.size() && std::isalpha(static_cast<unsigned char>(path[end])) == 0) ++end;
    const std::vector<double> n = numbersIn(path.mid(at, end - at).toStdString());
    at = end;
    if (command == 'M' && n.size() >= 2) drawn.lines.push_back({toPage({n[0], n[1]})});
    if (drawn.lines.empty()) continue;
    std::vector<Vec2>& line = drawn.lines.back();
    if (command == 'C') {
      for (std::size_t i = 0; i + 6 <= n.size(); i += 6) {
        const CubicBezier cubic = {pen, Vec2(n[i], n[i + 1]), Vec2(n[i + 2], n[i + 3]), Vec2(n[i + 4], n[i + 5])};
        for (int k = 1; k <= kSamplesPerCubic; ++k) {
          line.push_back(toPage(cubicPoint(cubic, static_cast<double>(k) / kSamplesPerCubic)));
        }
        pen = cubic.back();
      }
    } else if (command == 'L' || command == 'M') {
      for (std::size_t i = command == 'M' ? 2 : 0; i + 2 <= n.size(); i += 2) line.push_back(toPage({n[i], n[i + 1]}));
      if (n.size() >= 2) pen = Vec2(n[n.size() - 2], n[n.size() - 1]);
    } else if (command == 'Z') {
      line.push_back(Vec2(line.front()));
    }
  }
}

DrawnLines linesOfSvg(const std::string& text) {
  DrawnLines drawn;
  std::vector<double> box;
  QXmlStreamReader xml(QByteArray::fromStdString(text));
  while (!xml.atEnd()) {
    if (xml.readNext() != QXmlStreamReader::StartElement) continue;
    if (xml.name() == QLatin1String("svg")) {
      box = numbersIn(xml.attributes().value(QLatin1String("viewBox")).toLatin1().toStdString());
      if (box.size() != 4 || !(box[2] > 0.0) || !(box[3] > 0.0)) return {};
      drawn.aspect = box[2] / box[3];
    } else if (xml.name() == QLatin1String("path") && box.size() == 4) {
      addPath(xml.attributes().value(QLatin1String("d")).toLatin1(), box, drawn);
    }
  }
  return drawn;
}

}  // namespace

DrawnLines drawnLines(const std::string& output) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;  // limit of input
  const auto text = readWhole(output, kMostBytes);
  if (!text) return {};
  if (output.ends_with(".json")) return linesOfJson(*text);
  return output.ends_with(".svg") ? linesOfSvg(*text) : DrawnLines{};
}

}  // namespace batten::cli
