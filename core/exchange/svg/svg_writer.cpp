// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg/svg_writer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/number_text.h"
#include "core/exchange/model/cubic_outline.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/file_text.h"
#include "core/exchange/model/width_outline.h"

namespace batten {
namespace {

constexpr int kDecimals = 9;  // of numbers that are no paths
/// [mm] Places of paths hold this many decimals: so many that rounding leaves the curvature of short cubics alone.
constexpr int kPathDecimals = 12;
constexpr double kGridMm = 1e-12;           // as many decimals
constexpr double kLeastToleranceMm = 1e-6;  // limit of input

std::string fixed(double value) { return roundedText(value, kDecimals); }

std::string pointText(const Vec2& p) {
  return roundedText(p.x(), kPathDecimals) + "," + roundedText(p.y(), kPathDecimals);
}

void appendRun(std::string& data, const CubicRun& run) {
  for (const auto& cubic : run.cubics) {
    data.append(" C").append(pointText(cubic[0]));
    data.append(" ").append(pointText(cubic[1]));
    data.append(" ").append(pointText(cubic[2]));
  }
}

/// To user units, y down from the upper edge.
Vec2 inFile(const Vec2& mm, const PageFrame& frame, double unitsPerMm) {
  const double top = frame.bottomMm + frame.lengthToModel(frame.heightPx);
  return unitsPerMm * Vec2(mm.x() - frame.leftMm, top - mm.y());
}

/// The filled outline of a stroke; empty for lines without a width.
std::string outlineData(const WidthOutline& outline, const PageFrame& frame, double unitsPerMm) {
  std::string data;
  for (CubicRun loop : outline.loops) {
    loop.start = inFile(loop.start, frame, unitsPerMm);
    for (auto& cubic : loop.cubics)
      for (Vec2& p : cubic) p = inFile(p, frame, unitsPerMm);
    data.append(data.empty() ? "M" : " M").append(pointText(loop.start));
    appendRun(data, loop);
    data.append(" Z");
  }
  return data;
}

/// The path of a line in user units, y down from the upper edge.
Result<std::string> pathData(const ExportCurve& curve, const PageFrame& frame, const SvgOptions& options, SvgText& svg,
                             const RunContext& context) {
  const double unit = options.unitsPerMm;
  Eigen::Matrix2d flip;
  flip << unit, 0.0, 0.0, -unit;
  const Vec2 corner(-frame.leftMm, frame.bottomMm + frame.lengthToModel(frame.heightPx));
  const auto outline = cubicOutline(curve, flip, unit * corner, {unit * options.toleranceMm, kGridMm}, context);
  if (!outline) return fail(outline.error());
  svg.cubics += outline->cubics;
  svg.largestErrorMm = std::max(svg.largestErrorMm, outline->largestError / unit);
  svg.largestJump = std::max(svg.largestJump, outline->largestJump);
  std::string data;
  for (const CubicRun& run : outline->runs) {
    data.append(data.empty() ? "M" : " M").append(pointText(run.start));
    appendRun(data, run);
  }
  return outline->closed ? data + " Z" : data;
}

std::string metadata(const ExportDocument& document) {
  std::string text =
      "  <metadata>\n    <batten:curves version=\"1\" unit=\"mm\" axes=\"x right, y up from the lower edge\"";
  if (document.frame.leftMm != 0.0 || document.frame.bottomMm != 0.0) {
    text.append(" origin-mm=\"").append(exactNumber(document.frame.leftMm));
    text.append(",").append(exactNumber(document.frame.bottomMm)).append("\"");
  }
  text.append(" mm-per-px=\"").append(exactNumber(document.frame.mmPerPx));
  text.append("\" image-sha256=\"").append(xmlText(document.imageSha256)).append("\">\n");
  for (const ExportCurve& curve : document.curves) {
    text += "      <batten:curve id=\"" + xmlText(curve.id) + "\" closed=\"" + (curve.closed ? "true" : "false") + "\"";
    if (!curve.name.empty()) text += " name=\"" + xmlText(curve.name) + "\"";
    text += " layer=\"" + xmlText(curve.layer) + "\">\n";
    for (const ExportPiece& piece : curve.pieces) {
      text += "        <batten:piece degree=\"" + std::to_string(piece.curve.degree());
      if (!piece.name.empty()) text += "\" name=\"" + xmlText(piece.name);
      text += "\" knots=\"";
      for (const double knot : piece.curve.knots()) text += exactNumber(knot) + " ";
      text.back() = '"';
      text += " control-points=\"";
      for (const Vec2& p : piece.curve.controlPoints()) text += exactNumber(p.x()) + "," + exactNumber(p.y()) + " ";
      text.back() = '"';
      if (piece.curve.isRational()) {
        text += " weights=\"";
        for (const double weight : piece.curve.weights()) text += exactNumber(weight) + " ";
        text.back() = '"';
      }
      text += "/>\n";
    }
    text += "      </batten:curve>\n";
  }
  return text + "    </batten:curves>\n  </metadata>\n";
}

std::optional<Error> problemOf(const SvgOptions& options) {
  if (!(std::isfinite(options.toleranceMm) && options.toleranceMm >= kLeastToleranceMm))
    return Error{ErrorCode::BadParameter, "The tolerance of an SVG must be at least 0.000001 mm.", {}};
  if (!(std::isfinite(options.unitsPerMm) && options.unitsPerMm > 0.0))
    return Error{ErrorCode::BadParameter, "The user unit of an SVG must be larger than 0.", {}};
  if (!(std::isfinite(options.strokeWidthMm) && options.strokeWidthMm > 0.0))
    return Error{ErrorCode::BadParameter, "The stroke width of an SVG must be larger than 0 mm.", {}};
  return std::nullopt;
}

/// The strokes of the curves from `first` on that share its layer, as filled outlines in a layer of their own.
std::string outlineLayer(const ExportDocument& document, std::size_t first, int count, const SvgOptions& options,
                         const RunContext& context, SvgText& svg) {
  const std::string& layer = document.curves[first].layer;
  std::string paths;
  for (std::size_t i = first; i < document.curves.size() && document.curves[i].layer == layer; ++i) {
    if (context.isCancelled()) return {};
    const ExportCurve& curve = document.curves[i];
    const std::string data =
        outlineData(widthOutline(curve, options.toleranceMm, context), document.frame, options.unitsPerMm);
    if (data.empty()) continue;
    ++svg.outlines;
    const std::string id = xmlText(curve.id);
    paths.append("    <path id=\"").append(id).append("-width\" batten:").append(kWidthOf);
    paths.append("=\"").append(id).append("\" d=\"").append(data).append("\"/>\n");
  }
  if (paths.empty()) return {};
  return "  <g id=\"widths" + (count == 1 ? std::string() : std::string("-").append(std::to_string(count))) +
         "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + xmlText(layer) + " width\" fill=\"" +
         (count == 1 ? "#000000" : "#b00020") + "\" fill-rule=\"nonzero\" stroke=\"none\">\n" + paths + "  </g>\n";
}

/// The paths, a group for curves in a row that share a layer.
Result<std::string> layers(const ExportDocument& document, const SvgOptions& options, const RunContext& context,
                           SvgText& svg) {
  std::string text;
  int count = 0;
  for (std::size_t i = 0; i < document.curves.size(); ++i) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(i) / static_cast<double>(document.curves.size()));
    const ExportCurve& curve = document.curves[i];
    if (i == 0 || curve.layer != document.curves[i - 1].layer) {
      if (i > 0) text += "  </g>\n";
      ++count;
      if (options.widthOutlines) text += outlineLayer(document, i, count, options, context, svg);
      text += "  <g id=\"curves" + (count == 1 ? std::string() : std::string("-").append(std::to_string(count))) +
              "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + xmlText(curve.layer) +
              "\" fill=\"none\" stroke=\"" + (count == 1 ? "#000000" : "#b00020") + "\"\n     stroke-width=\"" +
              fixed(options.unitsPerMm * options.strokeWidthMm) +
              "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    }
    auto data = pathData(curve, document.frame, options, svg, context);
    if (!data) return data;
    const std::string label = curve.name.empty() ? "" : "\" inkscape:label=\"" + xmlText(curve.name);
    text += "    <path id=\"" + xmlText(curve.id) + label + "\" d=\"" + *data + "\"/>\n";
  }
  return text + "  </g>\n";
}

/// What the file is and how far its paths are off.
std::string description(const ExportDocument& document, const SvgText& svg) {
  return "  <title>" + xmlText(document.title) + "</title>\n  <desc>Fair curves in mm. " + kPathsLieWithin +
         fixed(svg.largestErrorMm) +
         " mm of the exact curves in the metadata; where cubics meet, the curvature jumps by at most " +
         roundedText(100.0 * svg.largestJump, 4) + " percent" +
         (svg.outlines > 0 ? "; filled outlines show the strokes in their width" : "") +
         (document.dpi ? " (" + fixed(*document.dpi) + " dpi)"
                       : "; the scan states no resolution, so the scale is assumed") +
         ".</desc>\n";
}

}  // namespace

Result<SvgText> writeSvg(const ExportDocument& document, const SvgOptions& options, const RunContext& context) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (auto problem = problemOf(options)) return fail(std::move(*problem));
  SvgText svg;
  const auto paths = layers(document, options, context, svg);
  if (!paths) return fail(paths.error());
  const double width = document.frame.lengthToModel(document.frame.widthPx);
  const double height = document.frame.lengthToModel(document.frame.heightPx);
  svg.text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
      "     xmlns:batten=\"urn:batten:curves:1\" version=\"1.1\"\n     width=\"" +
      fixed(width) + "mm\" height=\"" + fixed(height) + "mm\" viewBox=\"0 0 " + fixed(options.unitsPerMm * width) +
      " " + fixed(options.unitsPerMm * height) + "\">\n" + description(document, svg) + metadata(document) + *paths +
      "</svg>\n";
  return svg;
}

}  // namespace batten
