// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/svg_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include "core/base/shown_text.h"
#include "core/exchange/cubic_path.h"
#include "core/exchange/export_check.h"

namespace batten {
namespace {

/// [mm] Coordinates hold this many decimals: 0.1 nm, far below any tolerance, and never an exponent.
constexpr int kDecimals = 7;
constexpr double kGridMm = 1e-7;

/// Fixed notation without trailing zeros, C locale, no exponent, no minus zero.
std::string fixed(double value) {
  std::array<char, 400> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, kDecimals).ptr;
  std::string text(buffer.data(), end);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? std::string(1, '0') : text;
}

/// Exact shortest number for the metadata.
std::string exact(double value) {
  std::array<char, 40> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

/// Text for XML: markup escaped, and nothing that XML forbids.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : shownText(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string pointText(const Vec2& p) { return fixed(p.x()) + "," + fixed(p.y()); }

/// The same curve in the SVG's frame: mm with y down from the upper edge.
NurbsCurve toPage(const NurbsCurve& curve, const PageFrame& frame) {
  Eigen::Matrix2d flip;
  flip << 1.0, 0.0, 0.0, -1.0;
  return curve.mapped(flip, {0.0, frame.lengthToModel(frame.heightPx)});
}

void appendRun(std::string& data, const CubicRun& run) {
  for (const auto& cubic : run.cubics) {
    data.append(" C").append(pointText(cubic[0]));
    data.append(" ").append(pointText(cubic[1]));
    data.append(" ").append(pointText(cubic[2]));
  }
}

/// The pieces of a curve as runs without a gap. Where a piece begins where the last one ends, but for rounding, it
/// goes on there, and the shift counts as error.
Result<std::vector<CubicRun>> runsOf(const ExportCurve& curve, const PageFrame& frame, double toleranceMm,
                                     SvgText& svg) {
  std::vector<CubicRun> runs;
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    auto path = cubicPath(toPage(curve.pieces[i].curve, frame), toleranceMm, kGridMm);
    if (!path) return fail(path.error());
    for (std::size_t k = 0; k < path->runs.size(); ++k) {
      CubicRun& run = path->runs[k];
      svg.cubics += static_cast<int>(run.cubics.size());
      if (k == 0 && i > 0 && doMeet(curve.pieces[i - 1].curve, curve.pieces[i].curve)) {
        svg.largestErrorMm = std::max(svg.largestErrorMm, (runs.back().end() - run.start).norm());
        std::move(run.cubics.begin(), run.cubics.end(), std::back_inserter(runs.back().cubics));
      } else {
        runs.push_back(std::move(run));
      }
    }
    svg.largestErrorMm = std::max(svg.largestErrorMm, path->largestError);
  }
  return runs;
}

Result<std::string> pathData(const ExportCurve& curve, const PageFrame& frame, double toleranceMm, SvgText& svg) {
  auto runs = runsOf(curve, frame, toleranceMm, svg);
  if (!runs) return fail(runs.error());
  const bool closes = curve.closed && runs->size() == 1 && !runs->front().cubics.empty();
  if (closes) {
    // The end and the start are one point: write it alike, so that Z adds no line. The shift counts as error.
    CubicRun& loop = runs->front();
    svg.largestErrorMm = std::max(svg.largestErrorMm, (loop.end() - loop.start).norm());
    loop.cubics.back()[2] = loop.start;
  }
  std::string data;
  for (const CubicRun& run : *runs) {
    data.append(data.empty() ? "M" : " M").append(pointText(run.start));
    appendRun(data, run);
  }
  return closes ? data + " Z" : data;
}

std::string metadata(const ExportDocument& document) {
  std::string text =
      "  <metadata>\n    <batten:curves version=\"1\" unit=\"mm\" axes=\"x right, y up from the lower edge\"";
  text.append(" mm-per-px=\"").append(exact(document.frame.mmPerPx));
  text.append("\" image-sha256=\"").append(escaped(document.imageSha256)).append("\">\n");
  for (const ExportCurve& curve : document.curves) {
    text +=
        "      <batten:curve id=\"" + escaped(curve.id) + "\" closed=\"" + (curve.closed ? "true" : "false") + "\">\n";
    for (const ExportPiece& piece : curve.pieces) {
      text += "        <batten:piece degree=\"" + std::to_string(piece.curve.degree()) + "\" knots=\"";
      for (const double knot : piece.curve.knots()) text += exact(knot) + " ";
      text.back() = '"';
      text += " control-points=\"";
      for (const Vec2& p : piece.curve.controlPoints()) text += exact(p.x()) + "," + exact(p.y()) + " ";
      text.back() = '"';
      if (piece.curve.isRational()) {
        text += " weights=\"";
        for (const double weight : piece.curve.weights()) text += exact(weight) + " ";
        text.back() = '"';
      }
      text += "/>\n";
    }
    text += "      </batten:curve>\n";
  }
  return text + "    </batten:curves>\n  </metadata>\n";
}

}  // namespace

Result<SvgText> writeSvg(const ExportDocument& document, const SvgOptions& options) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  if (!(std::isfinite(options.toleranceMm) && options.toleranceMm >= 10.0 * kGridMm)) {
    return fail(ErrorCode::BadParameter, "The tolerance of an SVG must be at least 0.000001 mm.");
  }
  if (!(std::isfinite(options.strokeWidthMm) && options.strokeWidthMm > 0.0)) {
    return fail(ErrorCode::BadParameter, "The stroke width of an SVG must be larger than 0 mm.");
  }
  SvgText svg;
  std::string paths;
  for (const ExportCurve& curve : document.curves) {
    auto data = pathData(curve, document.frame, options.toleranceMm, svg);
    if (!data) return fail(data.error());
    paths += "    <path id=\"" + escaped(curve.id) + "\" d=\"" + *data + "\"/>\n";
  }
  const std::string width = fixed(document.frame.lengthToModel(document.frame.widthPx));
  const std::string height = fixed(document.frame.lengthToModel(document.frame.heightPx));
  svg.text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
      "     xmlns:batten=\"urn:batten:curves:1\" version=\"1.1\"\n"
      "     width=\"" +
      width + "mm\" height=\"" + height + "mm\" viewBox=\"0 0 " + width + " " + height +
      "\">\n"
      "  <title>" +
      escaped(document.title) +
      "</title>\n"
      "  <desc>Fair curves in mm. The cubic paths lie within " +
      fixed(svg.largestErrorMm) + " mm of the exact curves in the metadata" +
      (document.dpi ? " (" + fixed(*document.dpi) + " dpi)"
                    : "; the scan states no resolution, so the scale is assumed") +
      ".</desc>\n" + metadata(document) +
      "  <g id=\"curves\" inkscape:groupmode=\"layer\" inkscape:label=\"Curves\" fill=\"none\" stroke=\"#000000\"\n"
      "     stroke-width=\"" +
      fixed(options.strokeWidthMm) + "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n" + paths +
      "  </g>\n</svg>\n";
  return svg;
}

}  // namespace batten
