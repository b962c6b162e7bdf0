// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/curve_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/curve/line_names.h"
#include "core/exchange/cad/dxf_reader.h"
#include "core/exchange/cad/iges_reader.h"
#include "core/exchange/cad/step_reader.h"
#include "core/exchange/model/export_settings.h"
#include "core/exchange/svg/svg_reader.h"
#include "core/exchange/text/curve_json.h"

namespace batten {
namespace {

/// No drawing is near this; a file that is would take the memory of the machine.
constexpr std::uint64_t kLargestCurveBytes = 64 << 20;

constexpr double kPageMm = 0.1;  ///< [mm] A pixel of the page of a CAD file.
constexpr double kMostMm = 1e5;  ///< [mm] Curves beyond that are damage.

/// A CAD file keeps a smooth loop as a curve whose ends meet in place and direction.
bool isLoop(const NurbsCurve& curve) {
  constexpr double kSamePlace = 1e-9, kSameDirection = 1e-6;  // of the size; radians
  const auto& points = curve.controlPoints();
  if (points.size() < 4) return false;
  double size = 0.0;
  for (const Vec2& p : points) size = std::max(size, (p - points.front()).norm());
  const Vec2 out = points[1] - points.front(), in = points.back() - points[points.size() - 2];
  return (points.back() - points.front()).norm() <= kSamePlace * size &&
         std::abs(cross(in, out)) <= kSameDirection * in.norm() * out.norm() && in.dot(out) > 0.0;
}

Result<ExportDocument> documentOf(const CadDrawing& drawing) {
  if (drawing.entities.empty()) return fail(ErrorCode::NoCurve, "It contains no curve.");
  ExportDocument document;
  const Eigen::Matrix2d linear = drawing.mmPerUnit.value_or(1.0) * Eigen::Matrix2d::Identity();
  Vec2 far = Vec2::Ones();
  for (const CadEntity& entity : drawing.entities) {
    const auto curve = curveOf(entity.shape);
    if (!curve) return fail(curve.error());
    ExportCurve& line = document.curves.emplace_back();
    line.id = lineId(static_cast<int>(document.curves.size()), false);
    line.name = entity.name;
    if (!entity.layer.empty()) line.layer = entity.layer;
    line.pieces.push_back({curve->mapped(linear, Vec2::Zero())});
    line.closed = isLoop(line.pieces[0].curve);
    for (const Vec2& p : line.pieces[0].curve.controlPoints()) far = far.cwiseMax(p.cwiseAbs());
  }
  if (!(far.maxCoeff() < kMostMm))
    return fail(ErrorCode::BadParameter, "Its curves are farther than 100 m from the origin. Is its unit right?");
  document.frame = {static_cast<int>(std::ceil((far.x() + 1.0) / kPageMm)),
                    static_cast<int>(std::ceil((far.y() + 1.0) / kPageMm)), kPageMm};
  return document;
}

Result<ExportDocument> contentOf(const std::string& bytes, ExportFormat format) {
  if (format == ExportFormat::Json) return readCurveJson(bytes);
  if (format == ExportFormat::Svg) return readSvg(bytes);
  const auto drawing = format == ExportFormat::Iges   ? parseIges(bytes)
                       : format == ExportFormat::Step ? parseStep(bytes)
                                                      : readDxf(bytes);
  if (!drawing) return fail(drawing.error());
  return documentOf(*drawing);
}

}  // namespace

Result<ExportDocument> readCurveFile(const std::filesystem::path& path) {
  const auto format = formatOf(path).value_or(ExportFormat::Json);
  // formats that can be read as curves
  constexpr std::array kRead = {ExportFormat::Json, ExportFormat::Svg, ExportFormat::Dxf, ExportFormat::Iges,
                                ExportFormat::Step};
  if (std::find(kRead.begin(), kRead.end(), format) == kRead.end()) {
    return fail(ErrorCode::BadParameter, "Curves are not read from " + shownName(path.filename()) +
                                             ". Use a .json, .svg, .dxf, .igs or .step file.");
  }
  const auto bytes = readWhole(path, kLargestCurveBytes);
  if (!bytes) {
    return fail(ErrorCode::BadParameter, "The curves " + shownName(path) + " cannot be read: the file " +
                                             describe(bytes.error()) + ". Check the name.");
  }
  auto document = contentOf(*bytes, format);
  if (!document) {
    return fail(document.error().code, shownName(path) + ": " + document.error().message, document.error().detail);
  }
  return document;
}

}  // namespace batten
