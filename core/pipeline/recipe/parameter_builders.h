// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/base/result.h"
#include "core/base/shown_text.h"
#include "core/pipeline/recipe/parameter_table.h"

/// \file
/// One call per table entry. `field` is a generic lambda that returns the field of a recipe by reference, so that
/// reading and writing cannot name different fields: `[](auto& r) -> auto& { return r.filter.coefficient; }`.

namespace batten::table {

/// What the user reads about a parameter.
struct Words {
  std::string name, label, unit, help;  ///< As in Parameter.
  bool expert = false;
};

/// Range and look of a number.
struct Range {
  double minimum = 0.0, maximum = 1.0, step = 0.0;  ///< As in Parameter.
  int decimals = 0;
  bool logarithmic = false;
};

/// A word of a choice: as files and the command line write it, as the panel shows it, and the value behind it.
template <class T>
struct Word {
  std::string word, label;
  T value;
};

/// BadParameter: what a parameter cannot be, and what it must be.
inline tl::unexpected<Error> refuse(const std::string& name, std::string_view text, const std::string& expected) {
  return fail(ErrorCode::BadParameter, name + " cannot be " + quotedText(text) + ": " + expected + ".");
}

/// An entry with its words, without range, reader and writer.
inline Parameter described(StageId stage, Words words, ParameterType type) {
  Parameter p;
  p.stage = stage;
  p.type = type;
  p.name = std::move(words.name);
  p.label = std::move(words.label);
  p.unit = std::move(words.unit);
  p.help = std::move(words.help);
  p.expert = words.expert;
  return p;
}

/// What a number must be, for messages: "it must be a number from 0 to 100 px".
inline std::string rangeText(const Parameter& p) {
  return "it must be " + std::string(p.type == ParameterType::Integer ? "a whole number" : "a number") + " from " +
         numberToText(p.minimum) + " to " + numberToText(p.maximum) + (p.unit.empty() ? "" : " " + p.unit);
}

/// A switch: read as true, on, yes or 1 and their opposites.
template <class Field>
Parameter boolean(StageId stage, Words words, Field field) {
  Parameter p = described(stage, std::move(words), ParameterType::Boolean);
  p.choices = {"false", "true"};
  p.get = [field](const Recipe& r) { return std::string(field(r) ? "true" : "false"); };
  p.set = [field, name = p.name](Recipe& r, std::string_view text) -> Result<void> {
    const std::string_view word = trimmed(text);
    if (word == "true" || word == "on" || word == "yes" || word == "1") {
      field(r) = true;
    } else if (word == "false" || word == "off" || word == "no" || word == "0") {
      field(r) = false;
    } else {
      return refuse(name, text, "it must be true or false");
    }
    return {};
  };
  return p;
}

/// Gives an entry its range and look.
inline void setRange(Parameter& p, const Range& range) {
  p.minimum = range.minimum;
  p.maximum = range.maximum;
  p.step = range.step;
  p.decimals = range.decimals;
  p.logarithmic = range.logarithmic;
}

/// A number; what lies beyond the range is refused.
template <class Field>
Parameter real(StageId stage, Words words, Range range, Field field) {
  Parameter p = described(stage, std::move(words), ParameterType::Real);
  setRange(p, range);
  p.get = [field](const Recipe& r) { return numberToText(field(r)); };
  p.set = [field, range, name = p.name, expected = rangeText(p)](Recipe& r, std::string_view text) -> Result<void> {
    const auto value = numberFromText(text);
    if (!value || *value < range.minimum || *value > range.maximum) return refuse(name, text, expected);
    field(r) = *value;
    return {};
  };
  return p;
}

/// A whole number; what lies beyond the range is refused.
template <class Field>
Parameter integer(StageId stage, Words words, Range range, Field field) {
  Parameter p = described(stage, std::move(words), ParameterType::Integer);
  setRange(p, range);
  p.get = [field](const Recipe& r) { return std::to_string(field(r)); };
  p.set = [field, range, name = p.name, expected = rangeText(p)](Recipe& r, std::string_view text) -> Result<void> {
    const auto value = integerFromText(text);
    if (!value || *value < range.minimum || *value > range.maximum) return refuse(name, text, expected);
    field(r) = *value;
    return {};
  };
  return p;
}

/// One of several words.
template <class T, class Field>
Parameter choice(StageId stage, Words words, std::vector<Word<T>> all, Field field) {
  Parameter p = described(stage, std::move(words), ParameterType::Choice);
  std::string expected = "it must be one of";
  for (const Word<T>& one : all) {
    p.choices.push_back(one.word);
    p.choiceLabels.push_back(one.label);
    expected += (p.choices.size() == 1 ? " " : ", ") + one.word;
  }
  p.get = [field, all](const Recipe& r) {
    for (const Word<T>& one : all) {
      if (one.value == field(r)) return one.word;
    }
    return all.back().word;  // of several equivalent values the table names the strictest
  };
  p.set = [field, all, name = p.name, expected](Recipe& r, std::string_view text) -> Result<void> {
    for (const Word<T>& one : all) {
      if (one.word != trimmed(text)) continue;
      field(r) = one.value;
      return {};
    }
    return refuse(name, text, expected);
  };
  return p;
}

}  // namespace batten::table
