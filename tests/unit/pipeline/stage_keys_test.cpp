// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/stage_keys.h"

#include <gtest/gtest.h>

#include "core/pipeline/recipe/parameter_table.h"
#include "tests/unit/pipeline/ellipse_scan.h"
#include "tests/unit/pipeline/other_value.h"

namespace batten {
namespace {

StageKeys keysOf(const Recipe& recipe) {
  static const Scan scan = test::ellipseScan();
  return stageKeys(scan, recipe, {});
}

/// A parameter in no key would leave an old result on the screen and in the file.
TEST(StageKeys, EveryParameterChangesTheKeysFromItsStageOn) {
  const StageKeys before = keysOf({});
  for (const Parameter& p : parameterTable()) {
    SCOPED_TRACE(p.name);
    Recipe recipe;
    const auto done = p.set(recipe, test::otherValue(p));
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_NE(p.get(recipe), defaultValue(p));
    const StageKeys after = keysOf(recipe);
    for (const StageId stage : kStages) {
      // The edges picture is made beside the others: nothing after it reads it.
      const bool isBehind = p.stage == StageId::Edges ? stage == StageId::Edges : stage >= p.stage;
      if (stage == StageId::Edges && p.stage > StageId::Edges) continue;
      EXPECT_EQ(before[stage] != after[stage], isBehind && !p.isForDisplay) << name(stage);
    }
  }
}

TEST(StageKeys, EveryChoiceForACurveChangesItsFairing) {
  Recipe recipe;
  recipe.choices = {{.anchorsPx = {Vec2(1.0, 2.0)}}};
  const auto differs = [&](auto change) {
    Recipe after = recipe;
    change(after.choices.front());
    return keysOf(after)[StageId::Faired] != keysOf(recipe)[StageId::Faired];
  };
  EXPECT_TRUE(differs([](PieceChoice& c) { c.mode = FairingMode::None; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.target = FairingTarget::Recommended; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.toleranceMm = 0.2; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.lowPassMm = 20.0; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.keepExtrema = KeptExtrema{}; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.keepPx = {Vec2(1, 1)}; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.splitsPx = {Vec2(1, 1)}; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.profile = {{0.0, 0.1}, {1.0, 0.2}}; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.tolerancePolicy = TolerancePolicy::AsNeeded; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.means = FairingMeans::ControlPoints; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.startHold = EndHold{}; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.endHold = EndHold{}; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.included = false; }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.anchorsPx.push_back(Vec2(3, 4)); }));
  EXPECT_TRUE(differs([](PieceChoice& c) { c.isPart = true; }));
}

}  // namespace
}  // namespace batten
