// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/paper_presets.h"

#include <gtest/gtest.h>

#include "core/pipeline/recipe/parameter_table.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/unit/pipeline/ellipse_scan.h"

namespace batten {
namespace {

TEST(PaperPresets, SetEverythingAtOnceAndBack) {
  EXPECT_EQ(paperPresetNames(), "000, 001, 002, 004, default");
  Recipe recipe;
  recipe.fairing.toleranceMm = 0.7;
  const Recipe before = recipe;
  EXPECT_EQ(paperPresetOf(recipe)->id, "default");
  for (const PaperPreset& preset : paperPresets()) {
    ASSERT_TRUE(applyPaperPreset(preset, recipe));
    EXPECT_FALSE(validate(recipe)) << preset.id;
    for (const auto& [name, value] : preset.settings) EXPECT_EQ(findParameter(name)->get(recipe), value) << name;
    EXPECT_EQ(paperPresetOf(recipe)->id, preset.id);
    EXPECT_EQ(recipe.fairing.toleranceMm, 0.7) << "what no paper says stays";
    EXPECT_EQ(preset.cost.empty(), preset.id == "default");
  }
  EXPECT_EQ(recipe, before) << "the last one is the program's own way";
  recipe.segments.spacingPx += 1.0;
  EXPECT_EQ(paperPresetOf(recipe)->id, "default") << "a setting that no paper names";
  recipe.construct.lowPass = 3.0;
  EXPECT_EQ(paperPresetOf(recipe), nullptr);
  EXPECT_EQ(findPaperPreset("003"), nullptr);
}

TEST(PaperPresets, GiveACurveOfALine) {
  for (const PaperPreset& preset : paperPresets()) {
    Recipe recipe;
    ASSERT_TRUE(applyPaperPreset(preset, recipe));
    StageCache cache;
    const auto out = runPipeline(test::ellipseScan(), recipe, cache, {}, {});
    ASSERT_FALSE(out.error) << preset.id << " " << out.error->message;
    EXPECT_EQ(out.faired->curves.size(), 1u) << preset.id;
  }
}

}  // namespace
}  // namespace batten
