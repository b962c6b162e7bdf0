// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/placed_marks_file.h"

#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/recipe/recipe_json.h"

namespace batten {
namespace {

using Json = RecipeJson;

Json pairToJson(const Vec2& p) { return {p.x(), p.y()}; }

/// The places that an entry must hold, and nothing else.
std::optional<std::vector<Vec2>> placesFromJson(const Json& json, std::initializer_list<const char*> names) {
  if (!json.is_object()) return std::nullopt;
  std::vector<Vec2> places;
  for (const char* one : names) {
    const auto point = json.contains(one) ? pointFromJson(json[one]) : std::nullopt;
    if (!point) return std::nullopt;
    places.push_back(*point);
  }
  return places;
}

Result<bool> readScaleLine(const Json& json, Recipe& recipe) {
  const auto ends = placesFromJson(json, {"from", "to"});
  if (!ends || json.size() != 3 || !json.contains("mm") || !json["mm"].is_number()) {
    return refuseRecipe(
        "The recipe is damaged: \"scale\" does not hold just two places \"from\" and \"to\" and a length \"mm\".");
  }
  recipe.scaleLine = ScaleLine{(*ends)[0], (*ends)[1], json["mm"].get<double>()};
  return true;
}

Result<bool> readDirections(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"directions\" is not a list.");
  for (const Json& entry : json) {
    const auto places = placesFromJson(entry, {"at", "towards"});
    if (!places || entry.size() != 2)
      return refuseRecipe("The recipe is damaged: an entry of \"directions\" is not a pair of points.");
    recipe.directions.push_back({(*places)[0], (*places)[1]});
  }
  return true;
}

Result<bool> readStarts(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"starts\" is not a list of positions.");
  for (const Json& entry : json) {
    const auto point = pointFromJson(entry);
    if (!point) return refuseRecipe("The recipe is damaged: the start of a curve is not a pair of numbers [x, y].");
    recipe.starts.push_back({*point});
  }
  return true;
}

/// {"at": [x, y], "pairs": [[[x, y], [x, y]], ...]}
std::optional<JunctionChoice> junctionFromJson(const Json& json) {
  const auto at = placesFromJson(json, {"at"});
  if (!at || json.size() != 2 || !json.contains("pairs") || !json["pairs"].is_array()) return std::nullopt;
  JunctionChoice choice{(*at)[0], {}};
  for (const Json& pair : json["pairs"]) {
    const bool isPair = pair.is_array() && pair.size() == 2;
    const auto first = isPair ? pointFromJson(pair[0]) : std::nullopt;
    const auto second = isPair ? pointFromJson(pair[1]) : std::nullopt;
    if (!first || !second) return std::nullopt;
    choice.pairs.push_back({*first, *second});
  }
  return choice;
}

Result<bool> readJunctions(const Json& json, Recipe& recipe) {
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"junctions\" is not a list.");
  for (const Json& entry : json) {
    auto choice = junctionFromJson(entry);
    if (!choice)
      return refuseRecipe("The recipe is damaged: an entry of \"junctions\" must have \"at\" and \"pairs\" only.");
    recipe.edges.junctions.push_back(std::move(*choice));
  }
  return true;
}

/// {"mode": "outline", "radius": 12, "course": [[x, y], ...]}
Result<bool> readPainted(const Json& json, Recipe& recipe) {
  const auto damaged = [] {
    return refuseRecipe(
        "The recipe is damaged: an entry of \"painted\" must have \"mode\", \"radius\" and \"course\" only.");
  };
  if (!json.is_array()) return refuseRecipe("The recipe is damaged: \"painted\" is not a list.");
  for (const Json& entry : json) {
    const bool isWhole = entry.is_object() && entry.size() == 3 && entry.contains("mode") && entry.contains("radius") &&
                         entry.contains("course");
    auto course = isWhole ? pairsFromJson(entry["course"]) : std::nullopt;
    Recipe named;
    if (!course || !entry["radius"].is_number() || !entry["mode"].is_string() ||
        !setParameter(named, "edges.mode", entry["mode"].get<std::string>()))
      return damaged();
    recipe.edges.painted.push_back({std::move(*course), entry["radius"].get<double>(), named.edges.mode});
  }
  return true;
}

Json paintedToJson(const PaintedInk& painted) {
  Recipe named;
  named.edges.mode = painted.mode;
  Json course = Json::array();
  for (const Vec2& p : painted.coursePx) course.push_back(pairToJson(p));
  return {
      {"mode", findParameter("edges.mode")->get(named)}, {"radius", painted.radiusPx}, {"course", std::move(course)}};
}

Json junctionToJson(const JunctionChoice& choice) {
  Json pairs = Json::array();
  for (const BranchPair& pair : choice.pairs) pairs.push_back({pairToJson(pair.firstPx), pairToJson(pair.secondPx)});
  return {{"at", pairToJson(choice.positionPx)}, {"pairs", std::move(pairs)}};
}

}  // namespace

Result<bool> readPlacedMark(const std::string& name, const Json& value, Recipe& recipe) {
  if (name == "scale") return readScaleLine(value, recipe);
  if (name == "directions") return readDirections(value, recipe);
  if (name == "starts") return readStarts(value, recipe);
  if (name == "junctions") return readJunctions(value, recipe);
  if (name == "painted") return readPainted(value, recipe);
  return false;
}

void addPlacedMarks(const Recipe& recipe, Json& json) {
  if (const auto& line = recipe.scaleLine)
    json["scale"] = {{"from", pairToJson(line->fromPx)}, {"to", pairToJson(line->toPx)}, {"mm", line->lengthMm}};
  for (const DirectionMark& mark : recipe.directions)
    json["directions"].push_back({{"at", pairToJson(mark.positionPx)}, {"towards", pairToJson(mark.towardsPx)}});
  for (const StartMark& mark : recipe.starts) json["starts"].push_back(pairToJson(mark.positionPx));
  for (const JunctionChoice& choice : recipe.edges.junctions) json["junctions"].push_back(junctionToJson(choice));
  for (const PaintedInk& painted : recipe.edges.painted) json["painted"].push_back(paintedToJson(painted));
}

}  // namespace batten
