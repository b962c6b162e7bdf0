// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/export_job.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <new>

#include "core/document/export_builder.h"
#include "core/exchange/curve_json.h"
#include "core/exchange/save_atomically.h"
#include "core/exchange/svg_check.h"
#include "core/exchange/svg_writer.h"

namespace batten {
namespace {

/// Largest distance of corresponding control points and knots; the same structure is demanded.
Result<double> difference(const ExportDocument& a, const ExportDocument& b) {
  const auto differs = [] {
    return fail(ErrorCode::CannotWrite,
                "The file that was written reads back as something else. Export again, to another place.");
  };
  if (a.curves.size() != b.curves.size()) return differs();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    if (a.curves[i].pieces.size() != b.curves[i].pieces.size()) return differs();
    for (std::size_t j = 0; j < a.curves[i].pieces.size(); ++j) {
      const NurbsCurve &p = a.curves[i].pieces[j].curve, &q = b.curves[i].pieces[j].curve;
      if (p.degree() != q.degree() || p.controlPointCount() != q.controlPointCount()) return differs();
      for (std::size_t k = 0; k < p.controlPoints().size(); ++k)
        largest = std::max(largest, (p.controlPoints()[k] - q.controlPoints()[k]).norm());
      for (std::size_t k = 0; k < p.knots().size(); ++k)
        largest = std::max(largest, std::abs(p.knots()[k] - q.knots()[k]));
    }
  }
  return largest;
}

/// What a file holds now that it is written.
std::string readBack(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int pieceCount(const ExportDocument& document) {
  std::size_t count = 0;
  for (const auto& curve : document.curves) count += curve.pieces.size();
  return static_cast<int>(count);
}

Result<ExportOutcome> writeAsSvg(const ExportRequest& request, const ExportDocument& document) {
  SvgOptions options;
  options.toleranceMm = request.toleranceMm;
  auto svg = writeSvg(document, options);
  if (!svg) return fail(std::move(svg).error());
  if (auto saved = saveAtomically(request.path, svg->text); !saved) return fail(std::move(saved).error());
  const auto back = checkSvg(readBack(request.path), document);
  if (!back) return fail(back.error());
  return ExportOutcome{back->curves, pieceCount(document), back->cubics,
                       std::max(svg->largestErrorMm, back->largestErrorMm), request.path};
}

Result<ExportOutcome> writeAsJson(const ExportRequest& request, const ExportDocument& document) {
  auto json = writeCurveJson(document);
  if (!json) return fail(std::move(json).error());
  if (auto saved = saveAtomically(request.path, *json); !saved) return fail(std::move(saved).error());
  const auto back = readCurveJson(readBack(request.path));
  if (!back) return fail(back.error());
  const auto largest = difference(document, *back);
  if (!largest) return fail(largest.error());
  return ExportOutcome{static_cast<int>(document.curves.size()), pieceCount(document), 0, *largest, request.path};
}

}  // namespace

Result<ExportOutcome> runExport(const ExportRequest& request) {
  try {
    const ExportDocument document = exportDocument(request.output, request.recipe, *request.scan);
    if (document.curves.empty())
      return fail(ErrorCode::NoCurve,
                  "There is no curve to export. Take at least one curve in (its eye in the list of curves).");
    return request.format == ExportFormat::Svg ? writeAsSvg(request, document) : writeAsJson(request, document);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to export. Close other programs or leave some curves out.");
  }
}

ExportSize exportSize(const PipelineOutput& output) {
  ExportSize size;
  if (!output.faired) return size;
  Vec2 low(0, 0), high(0, 0);
  for (const TracedCurve& curve : output.faired->curves) {
    const NurbsCurve& shape = curve.faired.isEmpty() ? curve.sketched : curve.faired;
    if (!curve.included || shape.isEmpty()) continue;
    const int samples = std::max(64, 8 * shape.controlPointCount());
    for (int i = 0; i <= samples; ++i) {
      const Vec2 p = shape.point(shape.start() + (shape.end() - shape.start()) * i / samples);
      const bool first = size.curves == 0 && i == 0;
      low = first ? p : Vec2(low.cwiseMin(p));
      high = first ? p : Vec2(high.cwiseMax(p));
    }
    ++size.curves;
  }
  size.widthMm = high.x() - low.x();
  size.heightMm = high.y() - low.y();
  return size;
}

}  // namespace batten
