// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/recipe/stage_id.h"

namespace batten {

enum class ParameterType { Boolean, Integer, Real, Choice, Text };

/// One parameter of the recipe: the panel builds its control from this, the CLI its --set and its `parameters` list,
/// and the recipe file its reader and writer.
struct Parameter {
  std::string name;   ///< "filter.coefficient": stage, dot, parameter. Never changes once released.
  std::string label;  ///< "Neighbourhood coefficient"
  std::string unit;   ///< "px", "mm", "" …
  ParameterType type = ParameterType::Real;
  double minimum = 0.0, maximum = 1.0;  ///< Integer and Real.
  double step = 0.0;                    ///< Of the slider's arrow keys and the spin field; 0 = free.
  /// What `minimum` stands for where it is no number of its kind ("auto"), and the least value above it, where
  /// not the next.
  std::string minimumWord;
  std::optional<double> leastAbove;
  bool logarithmic = false;               ///< The slider's scale.
  int decimals = 0;                       ///< Shown by the panel.
  std::vector<std::string> choices;       ///< Choice: the words the CLI and files use.
  std::vector<std::string> choiceLabels;  ///< Choice: what the panel shows.
  std::string help;                       ///< One line: what it does, what a larger value means.
  bool expert = false;                    ///< Folded away in the panel.
  bool isForDisplay = false;              ///< Changes what is shown, never a result.
  StageId stage = StageId::Thresholds;    ///< First stage it affects.
  /// Value as text: numbers in the C locale with enough digits to read back exactly, "true"/"false", a choice word.
  std::function<std::string(const Recipe&)> get;
  /// Sets from text; BadParameter with name, value and range or choices if it does not fit. The recipe is unchanged
  /// then.
  std::function<Result<void>(Recipe&, std::string_view)> set;
};

/// All parameters, grouped by stage in the order of the panels. Built once.
std::span<const Parameter> parameterTable();
/// @return nullptr if there is none of that name.
const Parameter* findParameter(std::string_view name);
/// Sets one parameter by name. An unknown name lists the nearest known one.
Result<void> setParameter(Recipe&, std::string_view name, std::string_view value);
/// Default as text.
std::string defaultValue(const Parameter&);

}  // namespace batten
