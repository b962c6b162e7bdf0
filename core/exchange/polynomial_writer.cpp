// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/polynomial_writer.h"

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/curve/arc_length.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/cad_drawing.h"
#include "core/exchange/export_check.h"
#include "core/exchange/file_text.h"
#include "core/exchange/read_back.h"

namespace batten {
namespace {

constexpr std::size_t kBefore = 5;  ///< PolynomialColumns before the coefficients.
constexpr int kPolynomialPlaces = 200;

/// The piece at the size and in the unit of the file, over its arc length.
Result<NurbsCurve> overArcLength(const NurbsCurve& curve, const ExportSettings& settings) {
  const double size = settings.scale / millimetresPer(settings.unit);
  const NurbsCurve scaled = curve.mapped(size * Eigen::Matrix2d::Identity(), Vec2::Zero());
  return reparametrized(scaled, 0.0, ArcLength(scaled).total());
}

/// Place and weight: (w x, w y, w).
using Weighted = Eigen::Vector3d;

/// Coefficients of the powers of t = u - start: the k-th forward differences of the control points times the binomial
/// coefficients, over the k-th power of the width (Piegl & Tiller, The NURBS Book, 1.3).
std::vector<Weighted> coefficientsOf(std::vector<Weighted> difference, double width) {
  std::vector<Weighted> coefficients;
  const std::size_t degree = difference.size() - 1;
  double factor = 1.0;
  for (std::size_t k = 0; k <= degree; ++k) {
    coefficients.push_back(factor * difference[0]);
    for (std::size_t i = 0; i + k < degree; ++i) difference[i] = difference[i + 1] - difference[i];
    factor *= static_cast<double>(degree - k) / static_cast<double>(k + 1) / width;
  }
  return coefficients;
}

/// A polynomial piece of a curve, or the quotient of two.
struct PolynomialSpan {
  double start = 0.0, end = 0.0;
  std::vector<Weighted> coefficients;

  Vec2 at(double u) const {
    Weighted value = Weighted::Zero();
    for (auto it = coefficients.rbegin(); it != coefficients.rend(); ++it) value = value * (u - start) + *it;
    return value.head<2>() / value.z();
  }
};

/// The pieces of a curve: those of its weighted control points and those of its weights, which have the same knots.
Result<std::vector<PolynomialSpan>> spansOf(const NurbsCurve& curve) {
  const std::vector<double> knots(curve.knots().begin(), curve.knots().end());
  std::vector<Vec2> places, weights;
  for (std::size_t i = 0; i < curve.controlPoints().size(); ++i) {
    const double weight = curve.isRational() ? curve.weights()[i] : 1.0;
    places.emplace_back(weight * curve.controlPoints()[i]);
    weights.emplace_back(weight, 0.0);
  }
  const auto over = NurbsCurve::make(curve.degree(), knots, std::move(places));
  const auto under = NurbsCurve::make(curve.degree(), knots, std::move(weights));
  if (!over || !under) return fail(over ? under.error() : over.error());
  const auto above = bezierPieces(*over), below = bezierPieces(*under);
  if (!above || !below) return fail(above ? below.error() : above.error());
  std::vector<PolynomialSpan> spans;
  for (std::size_t i = 0; i < above->size(); ++i) {
    const BezierPiece &place = (*above)[i], &weight = (*below)[i];
    std::vector<Weighted> points;
    for (std::size_t k = 0; k < place.controlPoints.size(); ++k)
      points.emplace_back(place.controlPoints[k].x(), place.controlPoints[k].y(), weight.controlPoints[k].x());
    spans.push_back({place.start, place.end, coefficientsOf(std::move(points), place.end - place.start)});
  }
  return spans;
}

/// What the columns are: those of weights stand only where a curve has some.
struct PolynomialColumns {
  int degree = 1;
  bool hasWeights = false;

  int axes() const { return hasWeights ? 3 : 2; }
};

PolynomialColumns columnsOf(const ExportDocument& document) {
  PolynomialColumns columns;
  for (const ExportCurve& line : document.curves) {
    for (const ExportPiece& piece : line.pieces) {
      columns.degree = std::max(columns.degree, piece.curve.degree());
      columns.hasWeights = columns.hasWeights || piece.curve.isRational();
    }
  }
  return columns;
}

std::string header(const std::string& unit, const PolynomialColumns& columns) {
  std::string text = columns.hasWeights ? "# x = (x0 + x1 t + x2 t^2 + ...) / (w0 + w1 t + ...), "
                                        : "# x = x0 + x1 t + x2 t^2 + ..., ";
  text += "t = u - u_start, y alike; lengths in " + unit +
          ", x to the right, y up, from the lower left corner of the page.\ncurve,piece,span,u_start,u_end";
  for (int axis = 0; axis < columns.axes(); ++axis)
    for (int k = 0; k <= columns.degree; ++k) text.append(",").append(1, "xyw"[axis]).append(std::to_string(k));
  return text + "\n";
}

/// @param isRational else its weight is 1, whatever rounding made of it.
std::string row(const std::string& begin, const PolynomialSpan& span, const PolynomialColumns& columns,
                bool isRational) {
  std::string text = begin + "," + exactNumber(span.start) + "," + exactNumber(span.end);
  for (int axis = 0; axis < columns.axes(); ++axis) {
    const std::size_t count = axis == 2 && !isRational ? 1 : span.coefficients.size();
    for (std::size_t k = 0; k <= static_cast<std::size_t>(columns.degree); ++k) {
      text += ",";
      if (k < count) text += exactNumber(span.coefficients[k][axis]);
    }
  }
  return text + "\n";
}

/// One row as it was read.
std::optional<PolynomialSpan> spanOf(const std::vector<std::string>& fields, bool hasWeights) {
  const std::size_t axes = hasWeights ? 3 : 2;
  if (fields.size() < kBefore + 2 * axes || (fields.size() - kBefore) % axes != 0) return std::nullopt;
  const std::size_t count = (fields.size() - kBefore) / axes;
  const auto start = numberFromText(fields[3]), end = numberFromText(fields[4]);
  if (!start || !end) return std::nullopt;
  PolynomialSpan span{*start, *end, {}};
  for (std::size_t k = 0; k < count && !fields[kBefore + k].empty(); ++k) {
    Weighted coefficient(0.0, 0.0, k == 0 ? 1.0 : 0.0);
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const std::string& field = fields[kBefore + axis * count + k];
      if (axis == 2 && field.empty()) continue;
      const auto value = numberFromText(field);
      if (!value) return std::nullopt;
      coefficient[static_cast<Eigen::Index>(axis)] = *value;
    }
    span.coefficients.push_back(coefficient);
  }
  if (span.coefficients.empty()) return std::nullopt;
  return span;
}

/// All rows of a text; nothing if one is none.
std::optional<std::vector<PolynomialSpan>> rowsOf(std::string_view text) {
  std::vector<PolynomialSpan> spans;
  std::optional<bool> hasWeights;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    if (!hasWeights) {
      hasWeights = line.find(",w0") != std::string_view::npos;
      continue;
    }
    auto span = spanOf(csvFields(line), *hasWeights);
    if (!span) return std::nullopt;
    spans.push_back(std::move(*span));
  }
  return spans;
}

}  // namespace

Result<std::string> writePolynomials(const ExportDocument& document, const ExportSettings& settings) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  const PolynomialColumns columns = columnsOf(document);
  std::string text = header(nameOf(settings.unit), columns);
  for (const ExportCurve& line : document.curves) {
    for (std::size_t i = 0; i < line.pieces.size(); ++i) {
      const std::string name = entityName(line, i);
      const auto curve = overArcLength(line.pieces[i].curve, settings);
      if (!curve) return fail(curve.error());
      const auto spans = spansOf(*curve);
      if (!spans) return fail(spans.error());
      const std::string begin = csvField(line.name.empty() ? line.id : line.name) + "," + csvField(name) + ",";
      for (std::size_t k = 0; k < spans->size(); ++k)
        text += row(begin + std::to_string(k + 1), (*spans)[k], columns, curve->isRational());
    }
  }
  return text;
}

Result<double> checkPolynomials(std::string_view text, const ExportDocument& document, const ExportSettings& settings) {
  const auto spans = rowsOf(text);
  if (!spans) return readsBackOtherwise("a row that is no polynomial");
  std::size_t first = 0;
  double most = 0.0;
  for (const ExportCurve& line : document.curves) {
    for (const ExportPiece& piece : line.pieces) {
      const auto curve = overArcLength(piece.curve, settings);
      if (!curve) return fail(curve.error());
      const std::size_t count = curve->breaks().size() - 1;
      if (first + count > spans->size()) return readsBackOtherwise("too few rows");
      std::size_t k = first;
      for (int i = 0; i <= kPolynomialPlaces; ++i) {
        const double u = curve->start() + (curve->end() - curve->start()) * i / kPolynomialPlaces;
        while (k + 1 < first + count && u >= (*spans)[k].end) ++k;
        most = std::max(most, ((*spans)[k].at(u) - curve->point(u)).norm());
      }
      first += count;
    }
  }
  if (first != spans->size()) return readsBackOtherwise("too many rows");
  return most * millimetresPer(settings.unit);
}

}  // namespace batten
