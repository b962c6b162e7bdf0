// SPDX-License-Identifier: GPL-3.0-or-later
// Every step of the fit that goes along a whole piece looks at the run as it goes: once it is cancelled, none of them
// comes to a result.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/construct/fair/fair_frame.h"
#include "core/construct/fair/fair_piece.h"
#include "core/construct/fair/fair_plateaus.h"
#include "core/construct/fair/fair_posterior.h"
#include "core/construct/fair/fair_prepare.h"
#include "core/construct/fair/fair_structure.h"
#include "core/construct/fair/fair_structure_search.h"
#include "core/construct/fair/fewest_knots.h"
#include "core/construct/fair/sharp_features.h"
#include "core/construct/fair/smooth_sections.h"
#include "core/construct/light/light_curve.h"
#include "core/construct/light/light_reference.h"
#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

constexpr double kSigmaPx = 0.1, kDensity = 0.03;  // [px], [px^2 px] of the points
constexpr double kCutoffPx = 60.0;

ConstructPiece longWave() {
  const auto bends = test::curveOfCurvature(4000.0, [](double s) { return 0.012 * std::sin(s / 25.0); });
  ConstructPiece piece;
  piece.points = piecePoints(test::noisyPoints(bends, kSigmaPx, 3));
  return piece;
}

class CancelledFit : public testing::Test {
 protected:
  CancelledFit() { cancelled_.cancel.cancel(); }
  void SetUp() override {
    piece_ = prepareFairPiece(input_, true, std::nullopt, options_, running_);
    ASSERT_TRUE(piece_.frame);
    frame_ = assembleFrame(piece_.frame->base, piece_.data, options_, 4, running_);
    posterior_ = localPosterior(frame_, kDensity, prior(), 1, options_.emWidthPx, running_);
    ASSERT_TRUE(posterior_);
    structure_ = localExtrema(frame_, posterior_->mean);
    ASSERT_GT(structure_.extrema.size(), 40u);
  }
  std::vector<double> prior() const { return uniformPrior(frame_, kDensity, kCutoffPx); }

  const ConstructPiece input_ = longWave();
  const FairFitOptions options_;
  RunContext running_, cancelled_;
  FairPiece piece_;
  FairFrame frame_;
  std::optional<FairPosterior> posterior_;
  FairStructure structure_;
};

TEST_F(CancelledFit, HasNoPilotAndNoFrame) {
  EXPECT_TRUE(fitPilot(piece_.data, options_, running_));
  EXPECT_FALSE(fitPilot(piece_.data, options_, cancelled_));
  EXPECT_TRUE(assembleFrame(frame_.base, piece_.data, options_, 4, cancelled_).blocks.empty());
  EXPECT_TRUE(checkStations(frame_.base, 4, cancelled_).empty());
  EXPECT_FALSE(prepareFairPiece(input_, true, std::nullopt, options_, cancelled_).frame);
  const auto table = cutoffTable(frame_, cancelled_).valid;
  EXPECT_EQ(std::count(table.begin(), table.end(), true), 0);
  const double length = frame_.base.knots().length;
  EXPECT_TRUE(reframe(frame_.base, posterior_->mean, 0.0, length, running_));
  EXPECT_FALSE(reframe(frame_.base, posterior_->mean, 0.0, length, cancelled_));
  EXPECT_TRUE(offsetCurve(frame_.base, posterior_->mean, running_));
  EXPECT_FALSE(offsetCurve(frame_.base, posterior_->mean, cancelled_));
}

TEST_F(CancelledFit, HasNoPosteriorAndNoStructure) {
  EXPECT_FALSE(localPosterior(frame_, kDensity, prior(), 1, options_.emWidthPx, cancelled_));
  FairStructure one = structure_;
  EXPECT_TRUE(fitStructure(frame_, *posterior_, one, posterior_->mean, {}, running_));
  one = structure_;
  EXPECT_FALSE(fitStructure(frame_, *posterior_, one, posterior_->mean, {}, cancelled_));
  EXPECT_FALSE(findStructure(frame_, *posterior_, 20.0, {}, cancelled_));
  StructureFit fit;
  fit.c = posterior_->mean;
  one = structure_;
  EXPECT_EQ(withoutPlateaus(frame_, *posterior_, one, fit, cancelled_).c, fit.c);
}

TEST_F(CancelledFit, RemovesNoKnot) {
  const auto curve = offsetCurve(frame_.base, posterior_->mean, running_);
  ASSERT_TRUE(curve);
  const std::vector<FewestKnotsLimit> stations(4 * curve->knots().spans + 1, {0.5, 1e-3});
  FewestKnotsLimits limits;
  limits.stations = stations;
  EXPECT_TRUE(withFewestKnots(*curve, limits, running_));
  EXPECT_FALSE(withFewestKnots(*curve, limits, cancelled_));
}

TEST_F(CancelledFit, MeasuresNoPoint) {
  const auto curve = frame_.base.toNurbs(piece_.origin, piece_.origin);
  ASSERT_TRUE(curve);
  EXPECT_EQ(pointDeviation(*curve, input_, running_).points.size(), input_.points.size());
  EXPECT_TRUE(pointDeviation(*curve, input_, cancelled_).points.empty());
  SmoothSections sections(input_, true, options_);
  ConstructedPiece far;
  far.curve = *NurbsCurve::make(5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1},
                                {{0, 900}, {9, 900}, {19, 900}, {29, 900}, {39, 900}, {49, 900}});
  EXPECT_FALSE(sections.check({far}, false, cancelled_)) << "nothing was found to be cut";
  EXPECT_TRUE(sections.check({far}, false, running_));
}

TEST_F(CancelledFit, MakesNothingLight) {
  const auto curve = frame_.base.toNurbs();
  ASSERT_TRUE(curve);
  EXPECT_TRUE(LightReference::make(*curve, false, 0.5, {}, running_));
  EXPECT_FALSE(LightReference::make(*curve, false, 0.5, {}, cancelled_));
  const auto light = makeLight(*curve, false, {}, cancelled_);
  ASSERT_FALSE(light);
  EXPECT_EQ(light.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
