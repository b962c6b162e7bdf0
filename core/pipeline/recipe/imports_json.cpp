// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/imports_json.h"

#include <utility>

#include "core/base/number_text.h"
#include "core/base/shown_text.h"

namespace batten {
namespace {

using ImportJson = nlohmann::ordered_json;

tl::unexpected<Error> damagedImport(const std::string& what) {
  return fail(ErrorCode::BadParameter, "The recipe is damaged: " + what + ".");
}

ImportJson placesToJson(std::span<const Vec2> places) {
  ImportJson list = ImportJson::array();
  for (const Vec2& p : places) list.push_back({p.x(), p.y()});
  return list;
}

ImportJson curveToJson(const ImportedCurve& imported) {
  const NurbsCurve& curve = imported.curve;
  ImportJson json = ImportJson::object();
  if (!imported.name.empty()) json["name"] = imported.name;
  json["degree"] = curve.degree();
  json["knots"] = ImportJson::array();
  for (const double knot : curve.knots()) json["knots"].push_back(knot);
  json["points"] = placesToJson(curve.controlPoints());
  for (const double weight : curve.weights()) json["weights"].push_back(weight);
  return json;
}

ImportJson lineToJson(const ImportedLine& line) {
  ImportJson json = ImportJson::object();
  if (!line.name.empty()) json["name"] = line.name;
  if (!line.layer.empty()) json["layer"] = line.layer;
  json["closed"] = line.closed;
  if (line.curves.empty()) {
    json["points"] = placesToJson(line.points);
    if (!line.corners.empty()) json["corners"] = line.corners;
  } else {
    for (const ImportedCurve& curve : line.curves) json["curves"].push_back(curveToJson(curve));
  }
  return json;
}

Result<std::vector<double>> numbersOfImport(const ImportJson& json, const char* what) {
  std::vector<double> numbers;
  if (!json.is_array()) return damagedImport(std::string(what) + " of an imported curve are no list");
  for (const ImportJson& one : json) {
    if (!one.is_number()) return damagedImport(std::string(what) + " of an imported curve are not all numbers");
    numbers.push_back(one.get<double>());
  }
  return numbers;
}

Result<std::vector<Vec2>> placesOfImport(const ImportJson& json) {
  std::vector<Vec2> places;
  if (!json.is_array()) return damagedImport("the points of an imported line are no list");
  for (const ImportJson& one : json) {
    if (!one.is_array() || one.size() != 2 || !one[0].is_number() || !one[1].is_number())
      return damagedImport("a point of an imported line is not a pair of numbers [x, y]");
    places.emplace_back(one[0].get<double>(), one[1].get<double>());
  }
  return places;
}

Result<ImportedCurve> curveOfImport(const ImportJson& json) {
  if (!json.is_object() || !json.contains("degree") || !json.contains("knots") || !json.contains("points"))
    return damagedImport("an imported curve has no degree, knots and points");
  const auto degree = json["degree"].is_number_integer() ? integerFromText(json["degree"].dump()) : std::nullopt;
  if (!degree) return damagedImport("the degree of an imported curve is not a whole number");
  auto knots = numbersOfImport(json["knots"], "the knots");
  if (!knots) return fail(knots.error());
  auto points = placesOfImport(json["points"]);
  if (!points) return fail(points.error());
  std::vector<double> weights;
  if (json.contains("weights")) {
    auto given = numbersOfImport(json["weights"], "the weights");
    if (!given) return fail(given.error());
    weights = std::move(*given);
  }
  auto curve = NurbsCurve::make(*degree, std::move(*knots), std::move(*points), std::move(weights));
  if (!curve) return damagedImport("an imported curve is invalid (" + curve.error().message + ")");
  ImportedCurve imported{std::move(*curve)};
  if (json.contains("name")) {
    if (!json["name"].is_string()) return damagedImport("the name of an imported curve is not text");
    imported.name = json["name"].get<std::string>();
  }
  return imported;
}

Result<void> takeOfLine(const std::string& name, const ImportJson& value, ImportedLine& line) {
  if (name == "name" && value.is_string()) {
    line.name = value.get<std::string>();
  } else if (name == "layer" && value.is_string()) {
    line.layer = value.get<std::string>();
  } else if (name == "closed" && value.is_boolean()) {
    line.closed = value.get<bool>();
  } else if (name == "points") {
    auto points = placesOfImport(value);
    if (!points) return fail(points.error());
    line.points = std::move(*points);
  } else if (name == "corners" && value.is_array()) {
    for (const ImportJson& one : value) {
      const auto corner = one.is_number_integer() ? integerFromText(one.dump()) : std::nullopt;
      if (!corner) return damagedImport("a corner of an imported line is no whole number");
      line.corners.push_back(*corner);
    }
  } else if (name == "curves" && value.is_array()) {
    for (const ImportJson& one : value) {
      auto curve = curveOfImport(one);
      if (!curve) return fail(curve.error());
      line.curves.push_back(std::move(*curve));
    }
  } else {
    return damagedImport("it holds " + quotedText(name) +
                         " in an imported line, which this version of Batten does not know");
  }
  return {};
}

Result<ImportedFile> fileOfImport(const ImportJson& json) {
  ImportedFile file;
  if (!json.is_object() || !json.contains("lines") || !json["lines"].is_array())
    return damagedImport("an import has no lines");
  for (const auto& [name, value] : json.items()) {
    if (name == "lines") continue;
    if (!value.is_string() || (name != "source" && name != "unit"))
      return damagedImport("it holds " + quotedText(name) +
                           " in an import, which this version of Batten does not know");
    (name == "source" ? file.source : file.unit) = value.get<std::string>();
  }
  for (const ImportJson& one : json["lines"]) {
    if (!one.is_object()) return damagedImport("an imported line is not an object");
    ImportedLine& line = file.lines.emplace_back();
    for (const auto& [name, value] : one.items()) {
      if (auto taken = takeOfLine(name, value, line); !taken) return fail(taken.error());
    }
  }
  return file;
}

}  // namespace

nlohmann::ordered_json importsToJson(const std::vector<ImportedFile>& imports) {
  ImportJson list = ImportJson::array();
  for (const ImportedFile& file : imports) {
    ImportJson lines = ImportJson::array();
    for (const ImportedLine& line : file.lines) lines.push_back(lineToJson(line));
    list.push_back({{"source", file.source}, {"unit", file.unit}, {"lines", std::move(lines)}});
  }
  return list;
}

Result<std::vector<ImportedFile>> importsFromJson(const nlohmann::ordered_json& json) {
  std::vector<ImportedFile> imports;
  if (!json.is_array()) return damagedImport("\"imports\" is not a list");
  for (const ImportJson& one : json) {
    auto file = fileOfImport(one);
    if (!file) return fail(file.error());
    imports.push_back(std::move(*file));
  }
  return imports;
}

}  // namespace batten
