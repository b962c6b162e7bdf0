// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/text/polynomial_writer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/curve/arc_length.h"
#include "core/curve/bezier_powers.h"
#include "core/curve/bezier_quintics.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/cad_drawing.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/model/read_back.h"

namespace batten {
namespace {

constexpr std::size_t kBefore = 5;      ///< Columns before the coefficients.
constexpr int kPolynomialPlaces = 200;  // where a file that was read back is compared

constexpr double kNearEnough = 1e-12;  ///< Of the size of a rational curve: its polynomials may lie so far from it.
// polynomials for a span of a rational curve, doubled up to the most for the whole
constexpr int kStepsPerSpan = 8, kMostCurveSteps = 4096;

/// A rational curve as quintics over its arc length: they share place, direction and curvature with it at ever closer
/// places, until none in between is farther away than a millionth of a millionth of its size.
Result<NurbsCurve> inPolynomials(const NurbsCurve& rational) {
  const double most = kNearEnough * extent(rational);
  for (int steps = kStepsPerSpan * static_cast<int>(rational.breaks().size() - 1);; steps *= 2) {
    std::vector<Joint> joints;
    std::vector<double> lengths;
    const auto samples = sampleByArcLength(rational, 2 * steps + 1);
    for (std::size_t i = 0; i < samples.size(); i += 2) {
      joints.push_back({samples[i].point, samples[i].tangent, samples[i].kappa});
      if (i > 0) lengths.push_back(samples[i].s - samples[i - 2].s);
    }
    auto chain = hermiteChain(joints, lengths);
    if (!chain) return chain;
    double worst = 0.0;
    for (std::size_t i = 1; i < samples.size(); i += 2) {
      worst = std::max(worst, std::abs(cross(samples[i].tangent, chain->point(samples[i].s) - samples[i].point)));
    }
    if (worst <= most || steps >= kMostCurveSteps) return chain;
  }
}

/// The piece at the size and in the unit of the file.
NurbsCurve inUnits(const NurbsCurve& curve, const ExportSettings& settings) {
  const double size = settings.scale / millimetresPer(settings.unit);
  return curve.mapped(size * Eigen::Matrix2d::Identity(), Vec2::Zero());
}

/// The same over its arc length.
Result<NurbsCurve> overArcLength(const NurbsCurve& curve, const ExportSettings& settings) {
  const NurbsCurve scaled = inUnits(curve, settings);
  return scaled.isRational() ? inPolynomials(scaled) : reparametrized(scaled, 0.0, ArcLength(scaled).total());
}

int highestDegree(const ExportDocument& document) {
  constexpr int kOfRational = 5;  // degree of the polynomials for a rational curve
  int degree = 1;
  for (const ExportCurve& line : document.curves)
    for (const ExportPiece& piece : line.pieces)
      degree = std::max(degree, piece.curve.isRational() ? kOfRational : piece.curve.degree());
  return degree;
}

std::string polynomialHeader(const PageFrame& frame, const std::string& unit, int degree) {
  std::string text = "# x = x0 + x1 t + x2 t^2 + ..., t = u - u_start, y alike; lengths in " + unit +
                     ", x to the right, y up, from " + originOf(frame) + ".\ncurve,piece,span,u_start,u_end";
  for (const char* axis : {"x", "y"})
    for (int k = 0; k <= degree; ++k) text.append(",").append(axis).append(std::to_string(k));
  return text + "\n";
}

std::string row(const std::string& begin, const BezierPiece& piece, int degree) {
  const std::vector<Vec2> coefficients = powersOfBezier(piece.controlPoints, piece.end - piece.start);
  std::string text = begin + "," + exactNumber(piece.start) + "," + exactNumber(piece.end);
  for (const int axis : {0, 1}) {
    for (int k = 0; k <= degree; ++k) {
      text += ",";
      if (k < std::ssize(coefficients)) text += exactNumber(coefficients[k][axis]);
    }
  }
  return text + "\n";
}

/// One row as it was read.
struct ReadSpan {
  double start = 0.0, end = 0.0;
  std::vector<Vec2> coefficients;

  Vec2 at(double u) const {
    Vec2 value = Vec2::Zero();
    for (auto it = coefficients.rbegin(); it != coefficients.rend(); ++it) value = value * (u - start) + *it;
    return value;
  }
};

std::optional<ReadSpan> spanOf(const std::vector<std::string>& fields) {
  if (fields.size() < kBefore + 4 || (fields.size() - kBefore) % 2 != 0) return std::nullopt;
  const std::size_t count = (fields.size() - kBefore) / 2;
  const auto start = numberFromText(fields[3]), end = numberFromText(fields[4]);
  if (!start || !end) return std::nullopt;
  ReadSpan span{*start, *end, {}};
  for (std::size_t k = 0; k < count && !fields[kBefore + k].empty(); ++k) {
    const auto x = numberFromText(fields[kBefore + k]), y = numberFromText(fields[kBefore + count + k]);
    if (!x || !y) return std::nullopt;
    span.coefficients.emplace_back(*x, *y);
  }
  return span;
}

}  // namespace

Result<std::string> writePolynomials(const ExportDocument& document, const ExportSettings& settings,
                                     const RunContext& context) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (auto problem = validate(settings)) return fail(std::move(*problem));
  const int degree = highestDegree(document);
  std::string text = polynomialHeader(document.frame, nameOf(settings.unit), degree);
  std::size_t done = 0;
  for (const ExportCurve& line : document.curves) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(done++) / static_cast<double>(document.curves.size()));
    for (std::size_t i = 0; i < line.pieces.size(); ++i) {
      const std::string name = entityName(line, i);
      const auto curve = overArcLength(line.pieces[i].curve, settings);
      if (!curve) return fail(curve.error());
      const auto spans = bezierPieces(*curve);
      if (!spans) return fail(spans.error());
      const std::string begin = csvField(line.name.empty() ? line.id : line.name) + "," + csvField(name) + ",";
      for (std::size_t k = 0; k < spans->size(); ++k) text += row(begin + std::to_string(k + 1), (*spans)[k], degree);
    }
  }
  return text;
}

Result<double> checkPolynomials(std::string_view text, const ExportDocument& document, const ExportSettings& settings,
                                const RunContext& context) {
  std::vector<ReadSpan> spans;
  bool sawNames = false;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    if (!std::exchange(sawNames, true)) continue;
    auto span = spanOf(csvFields(line));
    if (!span) return readsBackOtherwise("a row that is no polynomial");
    spans.push_back(std::move(*span));
  }
  std::size_t first = 0;
  double most = 0.0;
  std::size_t done = 0;
  for (const ExportCurve& line : document.curves) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(done++) / static_cast<double>(document.curves.size()));
    for (const ExportPiece& piece : line.pieces) {
      const auto curve = overArcLength(piece.curve, settings);
      if (!curve) return fail(curve.error());
      const std::size_t count = curve->breaks().size() - 1;
      if (first + count > spans.size()) return readsBackOtherwise("too few rows");
      const NurbsCurve scaled = inUnits(piece.curve, settings);
      std::optional<ClosestPointFinder> finder;
      if (scaled.isRational()) finder.emplace(scaled);
      std::size_t k = first;
      for (int i = 0; i <= kPolynomialPlaces; ++i) {
        const double u = curve->start() + (curve->end() - curve->start()) * i / kPolynomialPlaces;
        while (k + 1 < first + count && u >= spans[k].end) ++k;
        const Vec2 read = spans[k].at(u);
        // Of a rational curve the places of one arc length are not known so exactly.
        most = std::max(most, finder ? finder->closestTo(read).distance : (read - curve->point(u)).norm());
      }
      first += count;
    }
  }
  if (first != spans.size()) return readsBackOtherwise("too many rows");
  return most * millimetresPer(settings.unit);
}

}  // namespace batten
