// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/parameter_table.h"

#include <algorithm>
#include <numeric>

#include "core/pipeline/parameter_builders.h"

namespace batten {
namespace {

std::vector<Parameter> buildTable() {
  std::vector<Parameter> table;
  table::appendImageParameters(table);
  table::appendCurveParameters(table);
  return table;
}

/// Number of single-letter changes that turn one word into the other.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
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
  return fail(ErrorCode::BadParameter,
              "There is no parameter \"" + std::string(name) + "\". Did you mean " + nearest->name + "?");
}

std::string defaultValue(const Parameter& p) { return p.get(Recipe{}); }

}  // namespace batten
