// SPDX-License-Identifier: GPL-3.0-or-later
// Every step of a fairing that goes along the whole curve looks at the run as it goes: once it is cancelled, none of
// them comes to a result.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/fairing/fairing.h"
#include "core/fairing/model/coarse_setups.h"
#include "core/fairing/model/fairing_line.h"
#include "core/fairing/model/fairing_model.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/line_blocks.h"
#include "core/fairing/model/sketch_deviation.h"
#include "core/fairing/structure/fair_as_needed.h"
#include "core/fairing/structure/monotone_search.h"
#include "core/fairing/structure/structure_candidates.h"
#include "core/fairing/structure/tolerance_fairing.h"
#include "core/fairing/target/low_pass.h"
#include "tests/support/clamped_knots.h"

namespace batten {
namespace {

constexpr int kPoints = 120;

NurbsCurve shakyWave() {
  std::vector<Vec2> points;
  for (int i = 0; i < kPoints; ++i) points.emplace_back(4.0 * i, 6.0 * std::sin(0.3 * i) + 0.2 * std::sin(1.9 * i));
  auto made = NurbsCurve::make(5, test::clampedUnitKnots(5, kPoints), std::move(points));
  EXPECT_TRUE(made);
  return std::move(*made);
}

class CancelledFairing : public testing::Test {
 protected:
  void SetUp() override {
    auto made = makeSetup(curve_, false, {}, context_);
    ASSERT_TRUE(made);
    setup_ = *made;
    moved_ = setup_->points;
    moved_[40] += Vec2(0.0, 0.7);
    state_ = evaluate(*setup_, {}, {}, moved_, setup_->start.places);
    ASSERT_TRUE(state_);
  }
  void cancel() { context_.cancel.cancel(); }

  const NurbsCurve curve_ = shakyWave();
  RunContext context_;
  std::shared_ptr<const FairingSetup> setup_;
  std::vector<Vec2> moved_;
  std::optional<FairingState> state_;
};

TEST_F(CancelledFairing, HasNoSetup) {
  EXPECT_FALSE(coarseSetups(setup_).empty());
  cancel();
  EXPECT_FALSE(makeSetup(curve_, false, {}, context_));
  EXPECT_TRUE(coarseSetups(setup_).empty());
}

TEST_F(CancelledFairing, TakesNoStep) {
  const FairingModel model(*setup_, {}, {}, *state_);
  EXPECT_TRUE(model.step(1e-3));
  cancel();
  EXPECT_FALSE(evaluate(*setup_, {}, {}, moved_, setup_->start.places));
  EXPECT_FALSE(model.step(1e-3)) << "assembled before";
  EXPECT_FALSE(FairingModel(*setup_, {}, {}, *state_).step(1e-3)) << "assembled afterwards";
}

TEST_F(CancelledFairing, MeasuresNothing) {
  EXPECT_GT(largestDeviation(*setup_, moved_, true), 0.1);
  FairingLine line;
  line.pixelMm = 0.1;
  for (int i = 0; i < 4000; ++i) line.points.push_back(curve_.point(curve_.start() + i * (kPoints - 5.0) / 4000.0));
  EXPECT_FALSE(lineBlocks(*setup_, line).blocks.empty());
  cancel();
  EXPECT_EQ(largestDeviation(*setup_, moved_, true), 0.0);
  EXPECT_TRUE(lineBlocks(*setup_, line).blocks.empty());
}

TEST_F(CancelledFairing, LooksForNoStructure) {
  const MonotoneSearch search(*setup_, 0.01, context_);
  EXPECT_FALSE(search.arcLength().empty());
  EXPECT_GT(search.countAllExtrema(setup_->points), 10);
  StructureCandidates candidates(setup_, context_);
  EXPECT_TRUE(candidates.isValid());
  cancel();
  EXPECT_TRUE(MonotoneSearch(*setup_, 0.01, context_).arcLength().empty());
  EXPECT_EQ(search.countAllExtrema(setup_->points), 0);
  EXPECT_FALSE(StructureCandidates(setup_, context_).isValid());
}

TEST_F(CancelledFairing, CountsNothingOnACurveThatStays) {
  EXPECT_GT(unchanged(curve_, false, Termination::NotRun, {}, context_).report.extremaBefore, 10);
  cancel();
  EXPECT_EQ(unchanged(curve_, false, Termination::NotRun, {}, context_).report.extremaBefore, 0);
}

TEST_F(CancelledFairing, SmoothsNoSamples) {
  std::vector<double> shaky;
  for (int i = 0; i < 500; ++i) shaky.push_back(std::sin(1.9 * i));
  EXPECT_NE(lowPass(shaky, 1.0, 40.0, false, context_), shaky);
  EXPECT_TRUE(lowPassedProfile(curve_, false, {}, context_));
  cancel();
  EXPECT_EQ(lowPass(shaky, 1.0, 40.0, false, context_), shaky);
  EXPECT_FALSE(lowPassedProfile(curve_, false, {}, context_));
}

TEST_F(CancelledFairing, IsNotTakenForACusp) {
  cancel();
  const FairingParams params;
  const auto evenly = fairWithinTolerance(setup_, params, context_);
  ASSERT_FALSE(evenly) << evenly->report.note;
  EXPECT_EQ(evenly.error().code, ErrorCode::Cancelled);
  const auto asNeeded = fairAsNeeded(setup_, params, {}, context_);
  ASSERT_FALSE(asNeeded) << asNeeded->report.note;
  EXPECT_EQ(asNeeded.error().code, ErrorCode::Cancelled);
}

TEST_F(CancelledFairing, FairsNothingInAnyMode) {
  cancel();
  for (const FairingMode mode :
       {FairingMode::Tolerance, FairingMode::Monotone, FairingMode::LowPass, FairingMode::Target}) {
    FairingParams params;
    params.mode = mode;
    params.target = FairingTarget::Degree3;
    const auto faired = fair(curve_, false, params, context_);
    ASSERT_FALSE(faired) << static_cast<int>(mode);
    EXPECT_EQ(faired.error().code, ErrorCode::Cancelled) << static_cast<int>(mode);
  }
}

}  // namespace
}  // namespace batten
