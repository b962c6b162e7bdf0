// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/parameter_table.h"

#include <algorithm>
#include <iterator>

#include "core/base/edit_distance.h"
#include "core/base/shown_text.h"
#include "core/pipeline/recipe/parameter_builders.h"
#include "core/pipeline/recipe/parameters_construct.h"
#include "core/pipeline/recipe/parameters_contours.h"
#include "core/pipeline/recipe/parameters_fairing.h"
#include "core/pipeline/recipe/parameters_image.h"

namespace batten {
namespace {

std::vector<Parameter> buildTable() {
  std::vector<Parameter> table;
  for (const auto part :
       {table::imageParameters, table::contourParameters, table::constructParameters, table::fairingParameters}) {
    std::ranges::move(part(), std::back_inserter(table));
  }
  return table;
}

/// A name without its stage is often meant: "coefficient" for "filter.coefficient".
std::size_t nameDistance(std::string_view asked, const std::string& known) {
  const std::string_view bare = std::string_view(known).substr(known.find('.') + 1);
  return std::min(editDistance(asked, known), editDistance(asked, bare) + (asked == bare ? 0 : 1));
}

}  // namespace

std::span<const Parameter> parameterTable() {
  static const std::vector<Parameter> table = buildTable();
  return table;
}

const Parameter* findParameter(std::string_view name) {
  for (const Parameter& p : parameterTable()) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

Result<void> setParameter(Recipe& recipe, std::string_view name, std::string_view value) {
  if (const Parameter* p = findParameter(name)) return p->set(recipe, value);
  const auto table = parameterTable();
  const auto nearest = std::min_element(table.begin(), table.end(), [&](const Parameter& a, const Parameter& b) {
    return nameDistance(name, a.name) < nameDistance(name, b.name);
  });
  const std::string unknown = "There is no parameter " + quotedText(name) + ". ";
  const bool isNear = isNearWord(name, nameDistance(name, nearest->name));
  return fail(ErrorCode::BadParameter,
              unknown + (isNear ? "Did you mean " + nearest->name + "?" : "batten-cli parameters lists them all."));
}

std::string defaultValue(const Parameter& p) { return p.get(Recipe{}); }

}  // namespace batten
