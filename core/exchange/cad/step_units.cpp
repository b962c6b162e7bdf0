// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/step_units.h"

#include <cstdint>
#include <map>
#include <string_view>

#include "core/base/angle.h"

namespace batten {
namespace {

constexpr int kDeepestUnit = 16;  // units by units

std::optional<double> millimetresOf(const StepData& data, std::uint64_t unit, int depth) {
  if (depth > kDeepestUnit) return std::nullopt;
  if (const auto si = data.record(unit, "SI_UNIT"); si && si->size() == 2) {
    if ((*si)[1].text != "METRE") return std::nullopt;
    static const std::map<std::string_view, double> kPrefixes = {{"KILO", 1e6},  {"DECI", 100.0}, {"CENTI", 10.0},
                                                                 {"MILLI", 1.0}, {"MICRO", 1e-3}, {"", 1000.0}};
    const auto prefix = kPrefixes.find((*si)[0].text);
    return prefix == kPrefixes.end() ? std::nullopt : std::optional(prefix->second);
  }
  const auto conversion = data.record(unit, "CONVERSION_BASED_UNIT");
  if (!conversion || conversion->size() < 2) return std::nullopt;
  auto measure = data.record((*conversion)[1], "LENGTH_MEASURE_WITH_UNIT");
  if (!measure) measure = data.record((*conversion)[1], "MEASURE_WITH_UNIT");
  if (!measure || measure->size() < 2) return std::nullopt;
  const auto times = data.measure((*measure)[0]);
  const auto base = StepData::idOf((*measure)[1]);
  const auto of = base ? millimetresOf(data, *base, depth + 1) : std::nullopt;
  return times && of ? std::optional(*times * *of) : std::nullopt;
}

}  // namespace

StepUnits readStepUnits(const StepData& data) {
  StepUnits units;
  for (const std::uint64_t id : data.records().order) {
    const auto assigned = data.record(id, "GLOBAL_UNIT_ASSIGNED_CONTEXT");
    if (!assigned || assigned->empty()) continue;
    for (const StepValue& unit : data.valuesOf((*assigned)[0])) {
      const auto unitId = StepData::idOf(unit);
      if (!unitId) continue;
      if (data.record(*unitId, "LENGTH_UNIT") && !units.mmPerUnit) units.mmPerUnit = millimetresOf(data, *unitId, 0);
      if (data.record(*unitId, "PLANE_ANGLE_UNIT") && data.record(*unitId, "CONVERSION_BASED_UNIT"))
        units.radiansPerUnit = kRadPerDeg;  // what is no radian is a degree
    }
  }
  return units;
}

}  // namespace batten
