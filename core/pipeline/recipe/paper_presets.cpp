// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/paper_presets.h"

#include <algorithm>
#include <map>

#include "core/pipeline/recipe/parameter_table.h"

namespace batten {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// What all papers leave out: they take black and white pixels as they are.
Settings withPixels(Settings own) {
  const Settings pixels = {{"threshold.smooth", "false"}, {"threshold.interpolate", "false"},
                           {"edges.subpixel", "false"},   {"corners.exact", "false"},
                           {"corners.auto", "false"},     {"paper.flatten", "false"},
                           {"fairing.spans", "whole"},    {"fairing.quantity", "radius"},
                           {"fairing.monotone", "false"}, {"fairing.choose", "similarity"}};
  own.insert(own.end(), pixels.begin(), pixels.end());
  return own;
}

std::vector<PaperPreset> makePresets() {
  std::vector<PaperPreset> presets;
  presets.push_back({"000", "Quintic NURBS from a sketch",
                     "Sturges' rule gives about ten segments whatever the length, so bends are cut by pixels; a third "
                     "of the distance as derivative makes wiggles; pixel borders are 0.3 px off, the grey values 0.01.",
                     withPixels({{"construct.method", "nurbs"},
                                 {"construct.start", "line"},
                                 {"construct.magnitude_as_in_paper", "true"},
                                 {"construct.gradients", "all"},
                                 {"construct.ends", "stations"},
                                 {"construct.closeness", "0"},
                                 {"segments.mode", "sturges"}})});
  presets.push_back({"001", "Bézier path",
                     "Sturges' rule gives about ten segments whatever the length; the path has one curvature at its "
                     "joints, but turns back at nearly every one; moving edge lengths alone reaches few targets.",
                     withPixels({{"construct.method", "bezier"},
                                 {"construct.start", "line"},
                                 {"construct.lowpass", "0"},
                                 {"construct.equalise", "true"},
                                 {"construct.ends", "stations"},
                                 {"construct.closeness", "0"},
                                 {"segments.mode", "sturges"},
                                 {"fairing.moves", "edges"}})});
  presets.push_back({"002", "Typical curves, grown",
                     "Each segment is kept whole: its error is multiplied by about 3.7 in the next one, so the chain "
                     "leaves the line after a few segments; lines and inflections have no typical curve.",
                     withPixels({{"construct.method", "typical"},
                                 {"construct.typical", "growing"},
                                 {"construct.growing_as_in_paper", "true"}})});
  presets.push_back(
      {"004", "Control polygon with repeated knots",
       "The curve runs beside its points and cuts bends; knots repeated as often as the order leave a gap "
       "before each corner, which dots on paper hide and a cutter does not.",
       withPixels({{"construct.method", "control-polygon"},
                   {"construct.start", "line"},
                   {"construct.degree", "3"},
                   {"construct.knots", "order"},
                   {"construct.removal", "step"},
                   {"construct.removal_step", "8"}})});
  std::map<std::string, std::string> defaults;
  for (const PaperPreset& preset : presets)
    for (const auto& [name, value] : preset.settings) defaults[name] = defaultValue(*findParameter(name));
  presets.push_back({"default", "The program's own way", "", Settings(defaults.begin(), defaults.end())});
  return presets;
}

}  // namespace

std::span<const PaperPreset> paperPresets() {
  static const std::vector<PaperPreset> presets = makePresets();
  return presets;
}

const PaperPreset* findPaperPreset(std::string_view id) {
  const auto all = paperPresets();
  const auto found = std::find_if(all.begin(), all.end(), [&](const PaperPreset& one) { return one.id == id; });
  return found == all.end() ? nullptr : &*found;
}

std::string paperPresetNames() {
  std::string names;
  for (const PaperPreset& preset : paperPresets()) names.append(names.empty() ? "" : ", ").append(preset.id);
  return names;
}

Result<void> applyPaperPreset(const PaperPreset& preset, Recipe& recipe) {
  Recipe changed = recipe;
  for (const auto* settings : {&paperPresets().back().settings, &preset.settings}) {
    for (const auto& [name, value] : *settings)
      if (auto set = setParameter(changed, name, value); !set) return set;
  }
  recipe = std::move(changed);
  return {};
}

const PaperPreset* paperPresetOf(const Recipe& recipe) {
  for (const PaperPreset& preset : paperPresets()) {
    Recipe applied = recipe;
    if (applyPaperPreset(preset, applied) && applied == recipe) return &preset;
  }
  return nullptr;
}

}  // namespace batten
