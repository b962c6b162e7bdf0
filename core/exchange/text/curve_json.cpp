// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/text/curve_json.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/base/json_text.h"
#include "core/base/shown_text.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/export_check.h"
#include "core/exchange/model/file_text.h"

namespace batten {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "batten-curves";  // what every file says it is
constexpr int kVersion = 1;                            // of the format

Json pointsToJson(std::span<const Vec2> points) {
  Json list = Json::array();
  for (const Vec2& p : points) list.push_back({p.x(), p.y()});
  return list;
}

Json figuresToJson(const PieceFigures& figures) {
  Json fairing{{"mode", figures.fairing}};
  if (figures.target) fairing["target"] = *figures.target;
  if (figures.toleranceMm > 0.0) {
    fairing["tolerance_mm"] = figures.toleranceMm;
    fairing["moved_mm"] = figures.movedMm;
  }
  return {{"fairing", std::move(fairing)},
          {"deviation_mm", {{"max", figures.largestOffMm}, {"rms", figures.typicalOffMm}}}};
}

Json widthToJson(const WidthProfile& profile) {
  Json samples = Json::array();
  for (const WidthSample& sample : profile.samples) samples.push_back({sample.s, sample.width});
  return {{"samples", std::move(samples)}, {"tolerance", profile.tolerance}};
}

/// Where the pieces of a line meet.
Json cornersToJson(const ExportCurve& line) {
  Json corners = Json::array();
  for (std::size_t i = line.closed ? 0 : 1; i < line.pieces.size() && line.pieces.size() > 1; ++i) {
    const NurbsCurve& curve = line.pieces[i].curve;
    const Vec2 at = curve.point(curve.start());
    corners.push_back({at.x(), at.y()});
  }
  return corners;
}

Result<Json> pieceToJson(const ExportPiece& piece, const PageFrame& frame) {
  const auto made = clamped(piece.curve);
  if (!made) return fail(made.error());
  const NurbsCurve& curve = *made;
  std::vector<Vec2> px;
  for (const Vec2& p : curve.controlPoints()) px.push_back(frame.pointToImage(p));
  Json json = Json::object();
  if (!piece.name.empty()) json["name"] = piece.name;
  if (piece.number) json["number"] = *piece.number;
  json["degree"] = curve.degree();
  json["knots"] = Json::array();
  for (const double knot : curve.knots()) json["knots"].push_back(knot);
  json["control_points_px"] = pointsToJson(px);
  json["control_points_mm"] = pointsToJson(curve.controlPoints());
  if (curve.isRational()) {
    json["weights"] = Json::array();
    for (const double weight : curve.weights()) json["weights"].push_back(weight);
  }
  if (piece.width) json["width_mm"] = widthToJson(*piece.width);
  if (piece.figures) json.update(figuresToJson(*piece.figures));
  return json;
}

tl::unexpected<Error> damaged(const std::string& what) {
  return fail(ErrorCode::BadParameter, "The curve file cannot be read: " + withoutFullStop(what) + ".");
}

/// A whole number as large as an int, else nothing: never what is left of a larger one.
std::optional<int> integerOf(const Json& json) {
  if (!json.is_number_integer()) return std::nullopt;
  const auto value = json.get<std::int64_t>();
  const int whole = static_cast<int>(value);
  const bool wrapped = json.is_number_unsigned() && value < 0;
  return whole == value && !wrapped ? std::optional(whole) : std::nullopt;
}

Result<NurbsCurve> pieceFromJson(const Json& json) {
  std::vector<Vec2> points;
  for (const Json& p : json.at("control_points_mm")) {
    if (p.size() != 2) return damaged("a control point is not a pair of numbers");
    points.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
  }
  std::vector<double> weights;
  if (json.contains("weights")) weights = json.at("weights").get<std::vector<double>>();
  const auto degree = integerOf(json.at("degree"));
  if (!degree) return damaged("a degree is not a whole number");
  return NurbsCurve::make(*degree, json.at("knots").get<std::vector<double>>(), std::move(points), std::move(weights));
}

Result<WidthProfile> widthFromJson(const Json& json) {
  WidthProfile profile;
  for (const Json& sample : json.at("samples")) {
    if (sample.size() != 2) return damaged("a sample of a width is not a pair of numbers");
    profile.samples.push_back({sample.at(0).get<double>(), sample.at(1).get<double>()});
  }
  profile.tolerance = json.at("tolerance").get<double>();
  if (!isValid(profile)) return damaged("the width along a curve is not a list of places and widths from its start on");
  return profile;
}

Result<ExportDocument> documentFromJson(const Json& json) {
  if (!json.is_object() || json.value("format", "") != kFormat) return damaged("it is not a \"batten-curves\" file");
  if (integerOf(json.at("version")) != kVersion) {
    const Json& version = json.at("version");
    const std::string said = version.is_string() ? version.get<std::string>() : version.dump();
    return damaged("it is of version " + (version.is_number() ? said : quotedText(said)) +
                   ", and this Batten reads version 1");
  }
  ExportDocument document;
  const Json& image = json.at("image");
  const auto width = integerOf(image.at("width")), height = integerOf(image.at("height"));
  if (!width || !height) return damaged("the size of its page is not a pair of whole numbers");
  document.frame = {*width, *height, json.at("mm_per_px").get<double>()};
  if (const Json& dpi = image.at("dpi"); !dpi.is_null()) document.dpi = dpi.get<double>();
  document.imageSha256 = image.at("sha256").get<std::string>();
  for (const Json& entry : json.at("curves")) {
    ExportCurve& curve = document.curves.emplace_back();
    curve.id = entry.at("id").get<std::string>();
    curve.closed = entry.at("closed").get<bool>();
    if (entry.contains("name")) curve.name = entry.at("name").get<std::string>();
    if (entry.contains("layer")) curve.layer = entry.at("layer").get<std::string>();
    if (curve.layer.empty()) return damaged("a layer has no name");
    if (entry.contains("stroke_width_mm")) {
      curve.strokeWidthMm = entry.at("stroke_width_mm").get<double>();
      if (!(*curve.strokeWidthMm > 0.0)) return damaged("a stroke width is not above 0");
    }
    for (const Json& piece : entry.at("pieces")) {
      auto made = pieceFromJson(piece);
      if (!made) return damaged("curve " + curve.id + " is invalid (" + withoutFullStop(made.error().message) + ")");
      ExportPiece& known = curve.pieces.emplace_back(ExportPiece{std::move(*made)});
      if (piece.contains("name")) known.name = piece.at("name").get<std::string>();
      if (piece.contains("number")) known.number = integerOf(piece.at("number"));
      if (piece.contains("width_mm")) {
        auto profile = widthFromJson(piece.at("width_mm"));
        if (!profile) return fail(profile.error());
        known.width = std::move(*profile);
      }
    }
  }
  if (auto problem = exportProblem(document)) return damaged(problem->message);
  return document;
}

}  // namespace

Result<std::string> writeCurveJson(const ExportDocument& document, const RunContext& context) {
  if (auto problem = exportProblem(document)) return fail(std::move(*problem));
  Json json{{"format", kFormat}, {"version", kVersion}, {"unit", "mm"}};
  json["image"] = {{"width", document.frame.widthPx},
                   {"height", document.frame.heightPx},
                   {"dpi", document.dpi ? Json(*document.dpi) : Json(nullptr)},
                   {"sha256", document.imageSha256}};
  json["mm_per_px"] = document.frame.mmPerPx;
  for (const auto& [name, value] : document.settings) json["settings"][name] = value;
  Json& curves = json["curves"] = Json::array();
  std::size_t done = 0;
  for (const ExportCurve& curve : document.curves) {
    if (context.isCancelled()) return cancelled();
    context.report(static_cast<double>(done++) / static_cast<double>(document.curves.size()));
    Json pieces = Json::array();
    for (const ExportPiece& piece : curve.pieces) {
      auto made = pieceToJson(piece, document.frame);
      if (!made) return fail(made.error());
      pieces.push_back(std::move(*made));
    }
    Json& entry = curves.emplace_back(Json{{"id", curve.id}, {"closed", curve.closed}});
    if (curve.closed) entry["continuity"] = continuityOf(curve.pieces);
    if (curve.strokeWidthMm) entry["stroke_width_mm"] = *curve.strokeWidthMm;
    if (!curve.name.empty()) entry["name"] = curve.name;
    entry["layer"] = curve.layer;
    if (curve.pieces.size() > 1) entry["corners_mm"] = cornersToJson(curve);
    entry["pieces"] = std::move(pieces);
  }
  return json.dump(1) + "\n";
}

Result<ExportDocument> readCurveJson(std::string_view text, const RunContext& context) {
  const auto json = parseJson(text, context);
  if (!json && json.error().code == ErrorCode::Cancelled) return cancelled();
  if (!json) {
    auto error = damaged(json.error().message);
    error.value().detail = json.error().detail;
    return error;
  }
  try {
    return documentFromJson(*json);
  } catch (const Json::exception& e) {
    auto error = damaged("it is incomplete or was not written by Batten");
    error.value().detail = e.what();
    return error;
  }
}

}  // namespace batten
