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
                     "Sturges' rule gives about ten segments for any length, so bends are missed by tens of "
                     "pixels, and half a segment is cut off at either end; derivatives of a third of the distance "
                     "produce wiggles; pixel borders are "
                     "accurate to 0.3 px, grey values to 0.01 px.",
                     withPixels({{"construct.method", "nurbs"},
                                 {"construct.start", "line"},
                                 {"construct.magnitude_as_in_paper", "true"},
                                 {"construct.gradients", "all"},
                                 {"construct.ends", "stations"},
                                 {"construct.closeness", "0"},
                                 {"segments.mode", "sturges"}})});
  presets.push_back({"001", "Bézier path",
                     "Sturges' rule gives about ten segments for any length; the path is G2 at its joints but "
                     "has a curvature extremum at nearly every one; few targets can be reached by edge "
                     "lengths alone.",
                     withPixels({{"construct.method", "bezier"},
                                 {"construct.start", "line"},
                                 {"construct.lowpass", "0"},
                                 {"construct.equalise", "true"},
                                 {"construct.ends", "stations"},
                                 {"construct.closeness", "0"},
                                 {"segments.mode", "sturges"},
                                 {"fairing.moves", "edges"}})});
  presets.push_back({"002", "Typical curves, grown",
                     "Each segment is kept in full: its error grows by a factor of about 3.7 per segment, so "
                     "the chain diverges from the line after a few segments; straight parts and inflections "
                     "have no typical curve.",
                     withPixels({{"construct.method", "typical"},
                                 {"construct.typical", "growing"},
                                 {"construct.growing_as_in_paper", "true"}})});
  presets.push_back({"004", "Control polygon with repeated knots",
                     "The curve does not pass through its points and cuts bends; knots of multiplicity equal "
                     "to the order leave a gap before each corner, visible to a cutter.",
                     withPixels({{"construct.method", "control-polygon"},
                                 {"construct.start", "line"},
                                 {"construct.degree", "3"},
                                 {"construct.knots", "order"},
                                 {"construct.removal", "step"},
                                 {"construct.removal_step", "8"}})});
  std::map<std::string, std::string> defaults;
  for (const PaperPreset& preset : presets)
    for (const auto& [name, value] : preset.settings) defaults[name] = defaultValue(*findParameter(name));
  presets.push_back({"default", "Program defaults", "", Settings(defaults.begin(), defaults.end())});
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
