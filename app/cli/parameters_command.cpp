// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/parameters_command.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/exit_codes.h"
#include "core/base/number_text.h"
#include "core/pipeline/recipe/parameter_table.h"

namespace batten::cli {
namespace {

bool isNumber(const Parameter& p) { return p.type == ParameterType::Integer || p.type == ParameterType::Real; }

std::string rangeOf(const Parameter& p) {
  if (isNumber(p)) return numberToText(p.minimum) + ".." + numberToText(p.maximum);
  if (p.type == ParameterType::Text) return "text";
  std::string words;
  for (const std::string& word : p.choices) words.append(words.empty() ? "" : "|").append(word);
  return words;
}

const char* typeOf(const Parameter& p) {
  switch (p.type) {
    case ParameterType::Boolean:
      return "boolean";
    case ParameterType::Integer:
      return "integer";
    case ParameterType::Real:
      return "real";
    case ParameterType::Choice:
      return "choice";
    case ParameterType::Text:
      return "text";
  }
  return "text";
}

nlohmann::ordered_json toJson(const Parameter& p) {
  nlohmann::ordered_json json{{"name", p.name}, {"label", p.label}, {"unit", p.unit}, {"type", typeOf(p)}};
  if (isNumber(p)) {
    json["minimum"] = p.minimum;
    json["maximum"] = p.maximum;
    json["logarithmic"] = p.logarithmic;
  }
  if (!p.choices.empty()) json["choices"] = p.choices;
  json["range"] = rangeOf(p);
  json["default"] = defaultValue(p);
  json["stage"] = name(p.stage);
  json["expert"] = p.expert;
  json["help"] = p.help;
  return json;
}

/// Number of characters shown: bytes that continue a UTF-8 character take no place.
std::size_t shownWidth(const std::string& text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

void printText() {
  using Row = std::array<std::string, 5>;
  std::vector<Row> rows{{"NAME", "UNIT", "RANGE", "DEFAULT", "WHAT IT DOES"}};
  for (const Parameter& p : parameterTable()) {
    rows.push_back({p.name, p.unit.empty() ? "-" : p.unit, rangeOf(p), defaultValue(p), p.help});
  }
  std::array<std::size_t, 4> widths{};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], shownWidth(row[i]) + 2);
  }
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i)
      std::cout << row[i] << std::string(widths[i] - shownWidth(row[i]), ' ');
    std::cout << row.back() << '\n';
  }
}

}  // namespace

int runParameters(bool asJson) {
  if (asJson) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Parameter& p : parameterTable()) list.push_back(toJson(p));
    std::cout << list.dump(1) << '\n';
  } else {
    printText();
  }
  return endOutput();
}

}  // namespace batten::cli
