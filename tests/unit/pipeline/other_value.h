// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/number_text.h"
#include "core/pipeline/recipe/parameter_table.h"

namespace batten::test {

/// A value that differs from the default, for every type.
inline std::string otherValue(const Parameter& p) {
  const std::string normal = defaultValue(p);
  switch (p.type) {
    case ParameterType::Boolean:
      return normal == "true" ? "false" : "true";
    case ParameterType::Choice:
      return p.choices.front() == normal ? p.choices.back() : p.choices.front();
    case ParameterType::Integer:
      return numberToText(normal == numberToText(p.maximum) ? p.minimum : p.maximum);
    case ParameterType::Real:
      return numberToText(p.minimum + (p.maximum - p.minimum) / 3.0);
    case ParameterType::Text:
      break;
  }
  if (p.name == "fairing.alpha") return "0.5";
  if (p.name == "fairing.profile") return "0:0.01 0.25:-0.5 1:0.02";
  if (p.name == "paper.rectify") return "10,20,300,24,310,420.5,8,400";
  if (p.name.starts_with("inks.")) return "black,215";
  std::string grid = "12.25";
  for (int i = 1; i < kRegions; ++i) grid += i % 3 == 0 ? ",0.1" : ",a";
  return grid;
}

}  // namespace batten::test
