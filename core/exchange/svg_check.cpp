// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg_check.h"

#include <QByteArray>
#include <QXmlStreamReader>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"

namespace batten {
namespace {

constexpr int kSamplesPerCubic = 8;

struct ReadPiece {
  int degree = 0;
  std::vector<double> knots, coordinates, weights;
};
struct ReadSvg {
  std::vector<std::vector<ReadPiece>> curves;
  std::vector<QByteArray> paths;
};

tl::unexpected<Error> differs(std::string detail) {
  return fail(ErrorCode::CannotWrite,
              "The file that was written reads back as something else. Export again, to another place.",
              std::move(detail));
}

/// All numbers of a text; blanks and commas part them.
std::vector<double> numbersIn(const QByteArray& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error == std::errc()) numbers.push_back(value);
    at = next > at ? next : at + 1;
  }
  return numbers;
}

Result<ReadSvg> parsed(std::string_view text) {
  QXmlStreamReader xml(QByteArray::fromRawData(text.data(), static_cast<qsizetype>(text.size())));
  ReadSvg svg;
  while (!xml.atEnd()) {
    if (xml.readNext() != QXmlStreamReader::StartElement) continue;
    const auto attributes = xml.attributes();
    const auto value = [&](const char* name) { return attributes.value(QLatin1String(name)).toLatin1(); };
    if (xml.name() == QLatin1String("curve")) {
      svg.curves.emplace_back();
    } else if (xml.name() == QLatin1String("piece")) {
      if (svg.curves.empty()) return differs("a piece outside of a curve");
      svg.curves.back().push_back({value("degree").toInt(), numbersIn(value("knots")),
                                   numbersIn(value("control-points")), numbersIn(value("weights"))});
    } else if (xml.name() == QLatin1String("path")) {
      svg.paths.push_back(value("d"));
    }
  }
  if (xml.hasError()) return differs(xml.errorString().toStdString());
  return svg;
}

bool isSame(const ReadPiece& read, const NurbsCurve& curve) {
  const auto points = curve.controlPoints();
  if (read.degree != curve.degree() || read.coordinates.size() != 2 * points.size()) return false;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (read.coordinates[2 * i] != points[i].x() || read.coordinates[2 * i + 1] != points[i].y()) return false;
  return std::ranges::equal(read.knots, curve.knots()) && std::ranges::equal(read.weights, curve.weights());
}

/// A path in the model frame: points along every cubic, its start and its end included.
using CubicPoints = std::array<Vec2, kSamplesPerCubic + 1>;
struct ReadPath {
  std::vector<CubicPoints> cubics;
  bool closes = false;
};

CubicPoints pointsAlong(const std::array<Vec2, 4>& c) {
  CubicPoints points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double t = static_cast<double>(k) / kSamplesPerCubic, r = 1.0 - t;
    points[k] = r * r * r * c[0] + 3 * r * r * t * c[1] + 3 * r * t * t * c[2] + t * t * t * c[3];
  }
  return points;
}

Result<ReadPath> pathOf(const QByteArray& data, const PageFrame& frame) {
  ReadPath path;
  Vec2 pen = Vec2::Zero();
  qsizetype at = 0;
  while (at < data.size()) {
    const char command = data[at++];
    if (command == ' ') continue;
    if (path.closes) return differs("a path that goes on behind its end");
    qsizetype end = at;
    while (end < data.size() && std::isalpha(static_cast<unsigned char>(data[end])) == 0) ++end;
    const std::vector<double> n = numbersIn(data.mid(at, end - at));
    at = end;
    const auto model = [&](std::size_t i) { return Vec2(n[i], frame.lengthToModel(frame.heightPx) - n[i + 1]); };
    if (command == 'M' && n.size() == 2) {
      pen = model(0);
    } else if (command == 'C' && n.size() == 6) {
      path.cubics.push_back(pointsAlong({pen, model(0), model(2), model(4)}));
      pen = model(4);
    } else if (command == 'Z' && n.empty()) {
      path.closes = true;
    } else {
      return differs("a path that is no chain of cubics");
    }
  }
  if (path.cubics.empty()) return differs("an empty path");
  return path;
}

/// Largest distance of a path from the pieces it was made of. Each piece ends where a cubic ends.
double distanceFromPieces(const std::vector<CubicPoints>& cubics, const ExportCurve& curve) {
  double worst = 0.0;
  std::size_t first = 0;
  for (std::size_t piece = 0; piece < curve.pieces.size() && first < cubics.size(); ++piece) {
    const NurbsCurve& exact = curve.pieces[piece].curve;
    const Vec2 start = exact.point(exact.start()), end = exact.point(exact.end());
    std::size_t last = cubics.size() - 1;
    for (std::size_t i = first; i < last && piece + 1 < curve.pieces.size(); ++i) {
      if ((cubics[i].back() - end).norm() <= 1e-3 * extent(exact)) last = i;
    }
    std::vector<Vec2> part;
    for (std::size_t i = first; i <= last; ++i) part.insert(part.end(), cubics[i].begin(), cubics[i].end());
    worst =
        std::max({worst, deviation(exact, part, true).max, (part.front() - start).norm(), (part.back() - end).norm()});
    first = last + 1;
  }
  return first == cubics.size() ? worst : std::numeric_limits<double>::infinity();
}

}  // namespace

Result<SvgCheck> checkSvg(std::string_view text, const ExportDocument& document) {
  auto svg = parsed(text);
  if (!svg) return fail(std::move(svg).error());
  if (svg->paths.size() != document.curves.size() || svg->curves.size() != document.curves.size())
    return differs("another number of curves");
  SvgCheck check;
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    const ExportCurve& curve = document.curves[i];
    if (svg->curves[i].size() != curve.pieces.size()) return differs("another number of pieces in " + curve.id);
    for (std::size_t k = 0; k < curve.pieces.size(); ++k)
      if (!isSame(svg->curves[i][k], curve.pieces[k].curve)) return differs("another B-spline in " + curve.id);
    const auto path = pathOf(svg->paths[i], document.frame);
    if (!path) return fail(path.error());
    if (path->closes != curve.closed) return differs("a path closed otherwise than " + curve.id);
    check.largestErrorMm = std::max(check.largestErrorMm, distanceFromPieces(path->cubics, curve));
    check.cubics += static_cast<int>(path->cubics.size());
    ++check.curves;
  }
  return check;
}

}  // namespace batten
