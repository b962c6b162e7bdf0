// SPDX-License-Identifier: GPL-3.0-or-later
// What goes along a whole curve looks at the run at every span or place: once it is cancelled, nothing of the curve is
// gone through any more.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"
#include "core/curve/curvature_structure.h"
#include "core/curve/sample_tree.h"
#include "core/curve/span_curve.h"
#include "core/curve/width_fit.h"
#include "tests/support/clamped_knots.h"

namespace batten {
namespace {

constexpr int kWavePoints = 400;

NurbsCurve longWave() {
  std::vector<Vec2> points;
  for (int i = 0; i < kWavePoints; ++i)
    points.emplace_back(4.0 * i, 6.0 * std::sin(0.8 * i) + 2.0 * std::sin(0.31 * i));
  auto made = NurbsCurve::make(5, test::clampedUnitKnots(5, kWavePoints), std::move(points));
  EXPECT_TRUE(made);
  return std::move(*made);
}

class CancelledCurveWork : public testing::Test {
 protected:
  CancelledCurveWork() { cancelled_.cancel.cancel(); }
  const NurbsCurve curve_ = longWave();
  RunContext running_, cancelled_;
};

TEST_F(CancelledCurveWork, FindsNoExtremumAndNoInflection) {
  EXPECT_GT(curvatureExtrema(curve_, 1e-6, false, running_).size(), 100u);
  EXPECT_TRUE(curvatureExtrema(curve_, 1e-6, false, cancelled_).empty());
  EXPECT_GT(countedExtrema(curve_, false, running_), 10);
  EXPECT_EQ(countedExtrema(curve_, false, cancelled_), 0);
  EXPECT_GT(inflections(curve_, 1e-6, false, running_).size(), 50u);
  EXPECT_TRUE(inflections(curve_, 1e-6, false, cancelled_).empty());
}

TEST_F(CancelledCurveWork, MeasuresNoDistance) {
  std::vector<Vec2> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(1.5 * i, 1.0);
  for (const bool ordered : {true, false}) {
    EXPECT_EQ(deviation(curve_, points, ordered, running_).count, 1000);
    EXPECT_EQ(deviation(curve_, points, ordered, cancelled_).count, 0);
  }
  EXPECT_GT(deviation(curve_, curve_, running_).count, 1000);
  EXPECT_EQ(deviation(curve_, curve_, cancelled_).count, 0);
}

TEST_F(CancelledCurveWork, PlacesNoSamples) {
  const SpanBasis basis(5, curve_.knots(), kWavePoints, 0);
  const SpanCurve spans(basis, curve_.controlPoints());
  EXPECT_TRUE(equalArcPlaces(spans, 2000, false, running_));
  EXPECT_FALSE(equalArcPlaces(spans, 2000, false, cancelled_));
  EXPECT_GT(sampleByArcLength(curve_, 50, running_).back().s, 1000.0);
  EXPECT_EQ(sampleByArcLength(curve_, 50, cancelled_).back().s, 0.0);
}

TEST_F(CancelledCurveWork, SimplifiesNoStructure) {
  std::vector<double> s, kappa;
  for (int i = 0; i < 3000; ++i) s.push_back(i), kappa.push_back(std::sin(0.5 * i));
  EXPECT_GT(structureLevels(s, kappa, 3000.0, false, running_).size(), 100u);
  EXPECT_EQ(structureLevels(s, kappa, 3000.0, false, cancelled_).size(), 1u) << "the one to begin with";
}

TEST_F(CancelledCurveWork, MeasuresNoLength) {
  EXPECT_GT(ArcLength(curve_, running_).total(), 1000.0);
  EXPECT_EQ(ArcLength(curve_, cancelled_).total(), 0.0);
  EXPECT_EQ(ArcLength(curve_, cancelled_).at(100.0), 0.0);
  EXPECT_EQ(ClosestPointFinder(curve_, cancelled_).places().size(), 1u);
}

TEST_F(CancelledCurveWork, RemovesNoWidth) {
  std::vector<WidthSample> measured;
  for (int i = 0; i < 4000; ++i) measured.push_back({i + 0.5, 5.0 + std::sin(0.001 * i)});
  EXPECT_LT(fittedWidths(measured, 4000.0, false, 1.0, running_).samples.size(), 100u);
  EXPECT_GT(fittedWidths(measured, 4000.0, false, 1.0, cancelled_).samples.size(), 500u);
}

}  // namespace
}  // namespace batten
