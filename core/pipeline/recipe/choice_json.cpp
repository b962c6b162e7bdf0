// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/choice_json.h"

#include <map>

#include "core/base/shown_text.h"
#include "core/pipeline/recipe/parameter_table.h"

namespace batten {
namespace {

/// A choice's own setting whose words the table knows; false where the name is none of these.
Result<bool> readWord(const std::string& name, const RecipeJson& value, PieceChoice& choice) {
  static const std::map<std::string, std::string> kParameters = {
      {"mode", "fairing.mode"},      {"spend", "fairing.spend"},           {"spans", "fairing.spans"},
      {"moves", "fairing.moves"},    {"hold_start", "fairing.hold_start"}, {"hold_end", "fairing.hold_end"},
      {"method", "construct.method"}};
  const auto known = kParameters.find(name);
  if (known == kParameters.end() || !value.is_string()) return false;
  Recipe named;
  if (auto set = setParameter(named, known->second, value.get<std::string>()); !set) return fail(set.error());
  if (name == "mode") choice.mode = named.fairing.mode;
  if (name == "spans") choice.spans = named.fairing.targets.spans;
  if (name == "spend") choice.tolerancePolicy = named.fairing.tolerancePolicy;
  if (name == "moves") choice.means = named.fairing.means;
  if (name == "hold_start") choice.startHold = named.fairing.startHold;
  if (name == "hold_end") choice.endHold = named.fairing.endHold;
  if (name == "method") choice.method = named.construct.method;
  return true;
}

std::optional<std::vector<SpanChoice>> spansFromJson(const RecipeJson& json) {
  if (!json.is_array()) return std::nullopt;
  std::vector<SpanChoice> spans;
  for (const RecipeJson& entry : json) {
    if (!entry.is_array() || entry.size() != 3) return std::nullopt;
    const auto place = pointFromJson(RecipeJson{entry[0], entry[1]});
    const auto degree = integerFromJson(entry[2]);
    if (!place || !degree) return std::nullopt;
    spans.push_back({*place, *degree});
  }
  return spans;
}

}  // namespace

RecipeJson choiceToJson(const PieceChoice& choice) {
  RecipeJson json = RecipeJson::object();
  // A single anchor in the form it always had.
  if (choice.anchorsPx.size() == 1) {
    json["anchor"] = {choice.anchorsPx[0].x(), choice.anchorsPx[0].y()};
  } else {
    for (const Vec2& p : choice.anchorsPx) json["anchors"].push_back({p.x(), p.y()});
  }
  json["included"] = choice.included;
  if (choice.isPart) json["part"] = true;
  Recipe own;  // the table knows the words of choices
  own.fairing = choice.fairing(own.fairing);
  const auto word = [&](bool isOwn, const char* key, const char* parameter) {
    if (isOwn) json[key] = findParameter(parameter)->get(own);
  };
  word(choice.mode.has_value(), "mode", "fairing.mode");
  word(choice.tolerancePolicy.has_value(), "spend", "fairing.spend");
  word(choice.spans.has_value(), "spans", "fairing.spans");
  word(choice.means.has_value(), "moves", "fairing.moves");
  word(choice.startHold.has_value(), "hold_start", "fairing.hold_start");
  word(choice.endHold.has_value(), "hold_end", "fairing.hold_end");
  if (choice.method) {
    Recipe named;
    named.construct.method = *choice.method;
    json["method"] = findParameter("construct.method")->get(named);
  }
  if (choice.detail) json["detail"] = *choice.detail;
  if (choice.target) json["target"] = static_cast<int>(*choice.target);
  if (choice.toleranceMm) json["tolerance"] = *choice.toleranceMm;
  if (choice.lowPassMm) json["low_pass"] = *choice.lowPassMm;
  if (choice.keepExtrema) json["keep_extrema"] = numberOf(*choice.keepExtrema);
  for (const auto& [name, places] : {std::pair("keep", &choice.keepPx), std::pair("splits", &choice.splitsPx)}) {
    for (const Vec2& p : *places) json[name].push_back({p.x(), p.y()});
  }
  for (const SpanChoice& span : choice.spanTargets)
    json["span_targets"].push_back({span.placePx.x(), span.placePx.y(), span.degree});
  for (const ProfilePoint& p : choice.profile) json["profile"].push_back({p.fraction, p.kappa});
  return json;
}

Result<PieceChoice> readChoice(const RecipeJson& json) {
  PieceChoice choice;
  if (!json.is_object()) return refuseRecipe("The recipe is damaged: an entry of \"choices\" is not an object.");
  for (const auto& [name, value] : json.items()) {
    const auto word = readWord(name, value, choice);
    if (!word) return fail(word.error());
    if (*word) continue;
    if (name == "anchor") {
      const auto point = pointFromJson(value);
      if (!point) return refuseRecipe("The recipe is damaged: the anchor of a choice is not a pair of numbers [x, y].");
      choice.anchorsPx = {*point};
    } else if (name == "included" && value.is_boolean()) {
      choice.included = value.get<bool>();
    } else if (name == "part" && value.is_boolean()) {
      choice.isPart = value.get<bool>();
    } else if (const auto whole = integerFromJson(value); whole && name == "target") {
      choice.target = targetOfNumber(*whole);
      if (!choice.target) return refuseRecipe("The recipe is damaged: the target of a choice must be 0 to 8.");
    } else if (name == "tolerance" && value.is_number()) {
      choice.toleranceMm = value.get<double>();
    } else if (name == "detail" && value.is_number()) {
      choice.detail = value.get<double>();
    } else if (name == "low_pass" && value.is_number()) {
      choice.lowPassMm = value.get<double>();
    } else if (whole && name == "keep_extrema") {
      choice.keepExtrema = keptExtremaOf(*whole);
    } else if (const auto pairs = pairsFromJson(value); pairs && name == "keep") {
      choice.keepPx = *pairs;
    } else if (pairs && name == "anchors") {
      choice.anchorsPx = *pairs;
    } else if (pairs && name == "splits") {
      choice.splitsPx = *pairs;
    } else if (const auto spans = spansFromJson(value); spans && name == "span_targets") {
      choice.spanTargets = *spans;
    } else if (pairs && name == "profile") {
      for (const Vec2& p : *pairs) choice.profile.push_back({p.x(), p.y()});
    } else {
      return refuseRecipe("The recipe holds " + quotedText(name) +
                          " in a choice, which this version of Batten does not know or cannot read.");
    }
  }
  if (choice.anchorsPx.empty()) return refuseRecipe("The recipe is damaged: a choice has no anchor.");
  return choice;
}

}  // namespace batten
