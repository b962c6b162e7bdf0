// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/recipe_file.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/json_text.h"
#include "core/base/number_text.h"
#include "core/base/shown_text.h"
#include "core/pipeline/recipe/choice_json.h"
#include "core/pipeline/recipe/imports_json.h"
#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/placed_marks_file.h"
#include "core/pipeline/recipe/recipe_json.h"

namespace batten {
namespace {

using Json = RecipeJson;

constexpr std::string_view kFormat = "batten-recipe";  // what every recipe says it is
constexpr int kVersion = 1;                            // of the format: a program reads its own and all before

Json parameterToJson(const Parameter& p, const Recipe& recipe) {
  const std::string text = p.get(recipe);
  switch (p.type) {
    case ParameterType::Boolean:
      return text == "true";
    case ParameterType::Integer:
      return *integerFromText(text);
    case ParameterType::Real:
      return *numberFromText(text);
    case ParameterType::Choice:
    case ParameterType::Text:
      break;
  }
  return text;
}

Json strokeToJson(const PenStroke& stroke) {
  Json points = Json::array();
  for (const Vec2& p : stroke.points) points.push_back({p.x(), p.y()});
  return {{"closed", stroke.closed}, {"points", std::move(points)}};
}

Result<void> readParameters(const Json& json, Recipe& recipe) {
  if (!json.is_object())
    return refuseRecipe("The recipe is damaged: \"parameters\" is not a list of names and values.");
  for (const auto& [name, value] : json.items()) {
    const auto text = valueText(value);
    if (!text) return refuseRecipe("The recipe is damaged: the value of " + name + " is neither a number nor a text.");
    if (auto set = setParameter(recipe, name, *text); !set) {
      return refuseRecipe("The recipe cannot be used. " + set.error().message);
    }
  }
  return {};
}

/// Sharp: [x, y]. Rounded: {"at": [x, y], "round": mm}, with "by": "radius" and "joint": "g1", "g2" or "g3" if need be.
std::optional<CornerMark> cornerFromJson(const Json& json) {
  CornerMark mark;
  const auto point = pointFromJson(json.is_object() && json.contains("at") ? json["at"] : json);
  if (!point) return std::nullopt;
  mark.positionPx = *point;
  if (!json.is_object()) return mark;
  for (const auto& [name, value] : json.items()) {
    if (name == "at") continue;
    if (name == "round" && value.is_number()) {
      mark.roundMm = value.get<double>();
    } else if (name == "by" && (value == "radius" || value == "distance")) {
      mark.roundBy = value == "radius" ? RoundingSize::Radius : RoundingSize::Distance;
    } else if (name == "joint" && (value == "g1" || value == "g2" || value == "g3")) {
      mark.joint = value == "g1"   ? RoundingJoint::Tangent
                   : value == "g2" ? RoundingJoint::Curvature
                                   : RoundingJoint::CurvatureSlope;
    } else {
      return std::nullopt;
    }
  }
  return mark;
}

Result<void> readCorners(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"corners\" is not a list of positions.");
  for (const Json& entry : json) {
    const auto mark = cornerFromJson(entry);
    if (!mark)
      return refuseRecipe("The recipe is damaged: a corner is not a pair of numbers [x, y], or a rounded one.");
    recipe.cornerMarks.push_back(*mark);
  }
  return {};
}

Result<void> readRefusedCorners(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"refused_corners\" is not a list of positions.");
  for (const Json& entry : json) {
    const auto point = pointFromJson(entry);
    if (!point) return refuseRecipe("The recipe is damaged: a refused corner is not a pair of numbers [x, y].");
    recipe.refusedCornersPx.push_back(*point);
  }
  return {};
}

Result<void> readStrokes(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"strokes\" is not a list.");
  for (const Json& entry : json) {
    if (!entry.is_object() || !entry.contains("points") || !entry["points"].is_array()) {
      return refuseRecipe("The recipe is damaged: a pen stroke has no list of points.");
    }
    PenStroke stroke;
    for (const auto& [name, value] : entry.items()) {
      if (name == "points") continue;
      if (name != "closed" || !value.is_boolean()) {
        return refuseRecipe("The recipe holds " + quotedText(name) +
                            " in a pen stroke, which this version of Batten does not know or cannot read.");
      }
      stroke.closed = value.get<bool>();
    }
    for (const Json& place : entry["points"]) {
      const auto point = pointFromJson(place);
      if (!point)
        return refuseRecipe("The recipe is damaged: a point of a pen stroke is not a pair of numbers [x, y].");
      stroke.points.push_back(*point);
    }
    recipe.penStrokes.push_back(std::move(stroke));
  }
  return {};
}

Result<void> readSegmentPoints(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"segment_points\" is not a list of positions.");
  for (const Json& entry : json) {
    const auto point = pointFromJson(entry);
    if (!point) return refuseRecipe("The recipe is damaged: a segment point is not a pair of numbers [x, y].");
    recipe.segmentPoints.push_back({*point});
  }
  return {};
}

Result<void> readPage(const Json& json, Recipe& recipe) {
  if (json.is_null()) return {};
  const bool isPlaced = json.is_array() && json.size() == 4 && json[2].is_number() && json[3].is_number();
  const bool isPair = isPlaced || (json.is_array() && json.size() == 2);
  const auto width = isPair ? integerFromJson(json[0]) : std::nullopt;
  const auto height = isPair ? integerFromJson(json[1]) : std::nullopt;
  if (!width || !height)
    return refuseRecipe("The recipe is damaged: the size of the page is not a pair of whole numbers.");
  recipe.page = BlankPage{*width, *height};
  if (isPlaced) {
    recipe.page->leftMm = json[2].get<double>();
    recipe.page->bottomMm = json[3].get<double>();
  }
  return {};
}

Result<void> readScanPage(const Json& json, Recipe& recipe) {
  if (!json.is_object()) return refuseRecipe("The recipe is damaged: \"scan_page\" is not an object.");
  for (const auto& [name, value] : json.items()) {
    const auto number = integerFromJson(value);
    if (name == "number" && number) {
      recipe.scanPage.number = *number;
    } else if (name == "pdf_dpi" && value.is_number()) {
      recipe.scanPage.pdfDpi = value.get<double>();
    } else {
      return refuseRecipe("The recipe holds " + quotedText(name) +
                          " in its scan_page, which this version of Batten does not know or cannot read.");
    }
  }
  return {};
}

Json numbersToJson(const CurveNumbers& numbers) {
  Json curves = Json::array();
  for (const NumberedCurve& curve : numbers.curves) {
    Json& places = curves.emplace_back(Json{{"number", curve.number}, {"places", Json::array()}})["places"];
    for (const Vec2& p : curve.placesPx) places.push_back({p.x(), p.y()});
  }
  return {{"last", numbers.lastGiven}, {"known", std::move(curves)}};
}

Json traceModesToJson(const Recipe& recipe) {
  Json modes = Json::array();
  for (const EdgeChoice& choice : recipe.edges.choices) {
    Recipe named;
    named.edges.mode = choice.mode;
    const std::string word = findParameter("edges.mode")->get(named);
    modes.push_back({{"at", {choice.positionPx.x(), choice.positionPx.y()}}, {"mode", word}});
  }
  return modes;
}

Json cornerToJson(const CornerMark& mark) {
  Json at = {mark.positionPx.x(), mark.positionPx.y()};
  if (!(mark.roundMm > 0.0)) return at;
  Json json{{"at", at}, {"round", mark.roundMm}};
  if (mark.roundBy == RoundingSize::Radius) json["by"] = "radius";
  if (mark.joint == RoundingJoint::Tangent) json["joint"] = "g1";
  if (mark.joint == RoundingJoint::CurvatureSlope) json["joint"] = "g3";
  return json;
}

Result<void> readChoices(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"choices\" is not a list.");
  for (const Json& entry : json) {
    auto choice = readChoice(entry);
    if (!choice) return fail(choice.error());
    recipe.choices.push_back(*choice);
  }
  return {};
}

Result<void> readExtrema(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"extrema\" is not a list.");
  for (const Json& entry : json) {
    if (!entry.is_object() || entry.size() != 2 || !entry.contains("at") || !entry.contains("keep")) {
      return refuseRecipe("The recipe is damaged: an entry of \"extrema\" must have \"at\" and \"keep\" only.");
    }
    const auto point = pointFromJson(entry["at"]);
    if (!point) return refuseRecipe("The recipe is damaged: the place of an extremum is not a pair of numbers [x, y].");
    if (!entry["keep"].is_boolean())
      return refuseRecipe("The recipe is damaged: \"keep\" of an extremum is not true or false.");
    recipe.extremumChoices.push_back({*point, entry["keep"].get<bool>()});
  }
  return {};
}

Result<void> readRegions(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"regions\" is not a list.");
  for (const Json& entry : json) {
    RegionOfInterest region;
    if (!entry.is_array()) return refuseRecipe("The recipe is damaged: a region is not a list of corners.");
    for (const Json& corner : entry) {
      const auto point = pointFromJson(corner);
      if (!point) return refuseRecipe("The recipe is damaged: a corner of a region is not a pair of numbers [x, y].");
      region.cornersPx.push_back(*point);
    }
    recipe.regions.push_back(std::move(region));
  }
  return {};
}

Result<void> readTraceModes(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"ways\" is not a list.");
  for (const Json& entry : json) {
    const bool isWhole = entry.is_object() && entry.size() == 2 && entry.contains("at") && entry.contains("mode");
    const auto point = isWhole ? pointFromJson(entry["at"]) : std::nullopt;
    Recipe named;
    if (!point || !entry["mode"].is_string() || !setParameter(named, "edges.mode", entry["mode"].get<std::string>())) {
      return refuseRecipe("The recipe is damaged: an entry of \"ways\" must have \"at\" and \"mode\" only.");
    }
    recipe.edges.choices.push_back({*point, named.edges.mode});
  }
  return {};
}

Result<void> readNumbers(const Json& json, Recipe& recipe) {
  const auto damaged = [] {
    return refuseRecipe(
        "The recipe is damaged: \"curves\" does not hold just the \"last\" number and the numbers and places "
        "\"known\". Without \"curves\" it can be used; its curves are numbered anew then.");
  };
  const bool isWhole = json.is_object() && json.size() == 2 && json.contains("last") && json.contains("known");
  const auto last = isWhole ? integerFromJson(json["last"]) : std::nullopt;
  if (!last || !json["known"].is_array()) return damaged();
  recipe.curveNumbers.lastGiven = *last;
  for (const Json& entry : json["known"]) {
    const bool isOne = entry.is_object() && entry.size() == 2 && entry.contains("number") && entry.contains("places");
    const auto number = isOne ? integerFromJson(entry["number"]) : std::nullopt;
    auto places = number ? pairsFromJson(entry["places"]) : std::nullopt;
    if (!places) return damaged();
    recipe.curveNumbers.curves.push_back({*number, std::move(*places)});
  }
  return {};
}

Result<void> checkHead(const Json& json) {
  if (!json.is_object() || !json.contains("format") || json["format"] != kFormat) {
    return refuseRecipe("This is not a Batten recipe. Choose a file that Batten saved as a recipe.");
  }
  if (!json.contains("version") || !json["version"].is_number_integer()) {
    return refuseRecipe("The recipe is damaged: it does not state its version.");
  }
  const int version = integerFromJson(json["version"]).value_or(std::numeric_limits<int>::max());
  if (version > kVersion) {
    return refuseRecipe("The recipe is of version " + json["version"].dump() + "; this Batten reads up to version " +
                        std::to_string(kVersion) + ". Use a newer Batten.");
  }
  if (version < 1) return refuseRecipe("The recipe is damaged: it states the version " + std::to_string(version) + ".");
  return {};
}

Result<void> readEntry(const std::string& name, const Json& value, Recipe& recipe) {
  if (name == "format" || name == "version") return {};
  if (name == "parameters") return readParameters(value, recipe);
  if (name == "corners") return readCorners(value, recipe);
  if (name == "refused_corners") return readRefusedCorners(value, recipe);
  if (name == "segment_points") return readSegmentPoints(value, recipe);
  if (name == "choices") return readChoices(value, recipe);
  if (name == "strokes") return readStrokes(value, recipe);
  if (name == "page") return readPage(value, recipe);
  if (name == "imports") {
    auto imports = importsFromJson(value);
    if (!imports) return fail(imports.error());
    recipe.imports = std::move(*imports);
    return {};
  }
  if (name == "scan_page") return readScanPage(value, recipe);
  if (name == "extrema") return readExtrema(value, recipe);
  if (name == "regions") return readRegions(value, recipe);
  if (name == "ways") return readTraceModes(value, recipe);
  if (name == "curves") return readNumbers(value, recipe);
  if (const auto mark = readPlacedMark(name, value, recipe); !mark || *mark) return mark.map([](bool) {});
  if (name != "dpi") {
    return refuseRecipe("The recipe holds " + quotedText(name) + ", which this version of Batten does not know.");
  }
  if (value.is_null()) return {};
  if (!value.is_number()) return refuseRecipe("The recipe is damaged: its resolution is not a number.");
  recipe.dpi = value.get<double>();
  return {};
}

}  // namespace

std::string recipeToJson(const Recipe& recipe) {
  Json json{{"format", kFormat}, {"version", kVersion}};
  json["dpi"] = recipe.dpi ? Json(*recipe.dpi) : Json(nullptr);
  Json& parameters = json["parameters"] = Json::object();
  for (const Parameter& p : parameterTable()) parameters[p.name] = parameterToJson(p, recipe);
  Json& corners = json["corners"] = Json::array();
  for (const CornerMark& mark : recipe.cornerMarks) corners.push_back(cornerToJson(mark));
  if (!recipe.refusedCornersPx.empty()) {
    Json& places = json["refused_corners"] = Json::array();
    for (const Vec2& place : recipe.refusedCornersPx) places.push_back({place.x(), place.y()});
  }
  if (!recipe.segmentPoints.empty()) {
    Json& places = json["segment_points"] = Json::array();
    for (const SegmentPoint& one : recipe.segmentPoints) places.push_back({one.positionPx.x(), one.positionPx.y()});
  }
  Json& choices = json["choices"] = Json::array();
  for (const PieceChoice& choice : recipe.choices) choices.push_back(choiceToJson(choice));
  // Only where there are any: recipes of drawings without them stay what they were.
  if (!recipe.penStrokes.empty()) {
    Json& strokes = json["strokes"] = Json::array();
    for (const PenStroke& stroke : recipe.penStrokes) strokes.push_back(strokeToJson(stroke));
  }
  if (recipe.scanPage != PageChoice{})
    json["scan_page"] = {{"number", recipe.scanPage.number}, {"pdf_dpi", recipe.scanPage.pdfDpi}};
  if (!recipe.imports.empty()) json["imports"] = importsToJson(recipe.imports);
  if (const auto& page = recipe.page) {
    json["page"] = {page->widthPx, page->heightPx};
    if (page->leftMm != 0.0 || page->bottomMm != 0.0)
      json["page"].insert(json["page"].end(), {page->leftMm, page->bottomMm});
  }
  Json& extrema = json["extrema"] = Json::array();
  for (const ExtremumChoice& choice : recipe.extremumChoices) {
    extrema.push_back({{"at", {choice.positionPx.x(), choice.positionPx.y()}}, {"keep", choice.keep}});
  }
  Json& regions = json["regions"] = Json::array();
  for (const RegionOfInterest& region : recipe.regions) {
    Json& polygon = regions.emplace_back(Json::array());
    for (const Vec2& p : region.cornersPx) polygon.push_back({p.x(), p.y()});
  }
  if (!recipe.edges.choices.empty()) json["ways"] = traceModesToJson(recipe);
  if (recipe.curveNumbers.lastGiven > 0) json["curves"] = numbersToJson(recipe.curveNumbers);
  addPlacedMarks(recipe, json);
  return json.dump(1) + "\n";
}

Result<Recipe> recipeFromJson(std::string_view text, const RunContext& context) {
  const auto json = parseJson(text, context);
  if (!json && json.error().code == ErrorCode::Cancelled) return cancelled();
  if (!json) {
    return refuseRecipe(
        "The recipe is damaged: " + json.error().message + ". Save it again, or start from the defaults.",
        json.error().detail);
  }
  try {
    if (auto head = checkHead(*json); !head) return fail(head.error());
    Recipe recipe;
    for (const auto& [name, value] : json->items()) {
      if (context.isCancelled()) return cancelled();
      if (auto read = readEntry(name, value, recipe); !read) return fail(read.error());
    }
    // The line says the resolution, whatever was written beside it.
    if (recipe.scaleLine && resolutionOf(*recipe.scaleLine)) recipe.dpi = resolutionOf(*recipe.scaleLine);
    if (auto wrong = validate(recipe))
      return refuseRecipe("The recipe cannot be used. " + wrong->message, wrong->detail);
    return recipe;
  } catch (const Json::exception& e) {
    return refuseRecipe("The recipe is damaged and cannot be read. Save it again, or start from the defaults.",
                        e.what());
  }
}

}  // namespace batten
