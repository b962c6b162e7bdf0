// SPDX-License-Identifier: GPL-3.0-or-later
#include <QByteArray>
#include <QXmlStreamReader>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/curve/curve_analysis.h"
#include "core/exchange/writers.h"

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

/// All numbers of a text; blanks, commas and path letters part them.
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

/// Points along a path, model frame, with the index at which each cubic begins; the last index ends the last cubic.
struct PathPoints {
  std::vector<Vec2> points;
  int cubics = 0;
};
Result<PathPoints> pointsOf(const QByteArray& data, const PageFrame& frame) {
  const std::vector<double> numbers = numbersIn(data);
  if (numbers.size() < 2 || (numbers.size() - 2) % 6 != 0) return differs("a path that is no chain of cubics");
  const auto model = [&](std::size_t i) {
    return Vec2(numbers[i], frame.lengthToModel(frame.heightPx) - numbers[i + 1]);
  };
  PathPoints path;
  path.points.push_back(model(0));
  for (std::size_t i = 0; i + 8 <= numbers.size(); i += 6, ++path.cubics) {
    const std::array<Vec2, 4> c = {model(i), model(i + 2), model(i + 4), model(i + 6)};
    for (int k = 1; k <= kSamplesPerCubic; ++k) {
      const double t = static_cast<double>(k) / kSamplesPerCubic, r = 1.0 - t;
      path.points.push_back(r * r * r * c[0] + 3 * r * r * t * c[1] + 3 * r * t * t * c[2] + t * t * t * c[3]);
    }
  }
  return path;
}

/// Largest distance of a path from the pieces it was made of. Each piece ends where a cubic ends.
double distanceFromPieces(const std::vector<Vec2>& points, const ExportCurve& curve) {
  double worst = 0.0;
  std::size_t first = 0;
  for (std::size_t piece = 0; piece < curve.pieces.size(); ++piece) {
    const NurbsCurve& exact = curve.pieces[piece].curve;
    std::size_t last = points.size() - 1;
    if (piece + 1 < curve.pieces.size()) {
      const Vec2 end = exact.point(exact.end());
      // Nearest joint beyond the first: a closed piece starts where it ends.
      std::size_t best = last;
      for (std::size_t i = first + kSamplesPerCubic; i < points.size(); i += kSamplesPerCubic) {
        if ((points[i] - end).norm() > 1e-3 * extent(exact)) continue;
        best = i;
        break;
      }
      last = best;
    }
    const std::span<const Vec2> part(points.data() + first, last - first + 1);
    worst = std::max(worst, deviation(exact, part, true).max);
    first = last;
  }
  return worst;
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
    const auto path = pointsOf(svg->paths[i], document.frame);
    if (!path) return fail(path.error());
    check.largestErrorMm = std::max(check.largestErrorMm, distanceFromPieces(path->points, curve));
    check.cubics += path->cubics;
    ++check.curves;
  }
  return check;
}

}  // namespace batten
