// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/pipeline/run/curve_targets.h"
#include "core/pipeline/run/pipeline.h"
#include "tests/support/render_page.h"

/// \file
/// Whole traces of rendered drawings against expected/<scene>.json: every figure with its value and tolerance. Lengths,
/// corners and distances are known from the truth; the rest is what the program gave when it was looked at. A failing
/// scene leaves <scene>.actual.json in the build folder.

namespace batten {
namespace {

using nlohmann::json;

constexpr int kWidth = 640, kHeight = 480;

struct Scene {
  const char* name;
  const char* shape;
  bool stroke;
  ConstructMethod method;
  FairingMode mode;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

Scan render(const Scene& scene, const test::TruthShape& truth) {
  const auto outline = truth.outline();
  auto coverage = scene.stroke ? test::strokeCoverage(outline, truth.closed, 5.0, kWidth, kHeight)
                               : test::fillCoverage(outline, kWidth, kHeight);
  return test::renderPage(std::move(coverage), kWidth, kHeight, test::scannedPage(11));
}

double polylineLength(const std::vector<Vec2>& points, bool closed) {
  double length = closed ? (points.front() - points.back()).norm() : 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// rms and largest distance [px] of the truth from the traced curves.
std::pair<double, double> distanceOfTruth(const test::TruthShape& truth, const PipelineOutput& out) {
  double sum = 0.0, worst = 0.0;
  int count = 0;
  const auto outline = truth.outline();
  for (std::size_t i = 0; i < outline.size(); i += 41) {
    double nearest = 1e9;
    for (const TracedCurve& curve : out.faired->curves) {
      nearest = std::min(nearest, closestPoint(curve.faired, out.frame.pointToModel(outline[i])).distance);
    }
    nearest = out.frame.lengthToImage(nearest);
    sum += nearest * nearest;
    worst = std::max(worst, nearest);
    ++count;
  }
  return {std::sqrt(sum / count), worst};
}

double worstCornerError(const test::TruthShape& truth, const PipelineOutput& out) {
  double worst = 0.0;
  for (const Vec2& corner : truth.corners) {
    double nearest = 1e9;
    for (const Corner& found : out.pieces->corners) nearest = std::min(nearest, (found.positionPx - corner).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

json figuresOf(const test::TruthShape& truth, const PipelineOutput& out) {
  const auto [rms, worst] = distanceOfTruth(truth, out);
  double length = 0.0;
  int controlPoints = 0, extrema = 0;
  for (const TracedCurve& curve : out.faired->curves) {
    length += out.frame.lengthToImage(curve.fairedFigures.lengthMm);
    controlPoints += curve.fairedFigures.controlPoints;
    extrema += curve.fairedFigures.extrema;
  }
  const auto targets = targetsFor(out.faired->curves.front(), {});
  const auto similarity = targets ? targets->targets.profiles[5].similarity : 0.0;
  return {{"curves", out.faired->curves.size()},
          {"corners", out.pieces->corners.size()},
          {"worst_corner_px", worstCornerError(truth, out)},
          {"length_ratio", length / polylineLength(truth.outline(), truth.closed)},
          {"truth_rms_px", rms},
          {"truth_max_px", worst},
          {"control_points", controlPoints},
          {"curvature_extrema", extrema},
          {"similarity_of_target_6", similarity}};
}

class Golden : public ::testing::TestWithParam<Scene> {};

TEST_P(Golden, FiguresStayWithinTheirTolerance) {
  const Scene scene = GetParam();
  const auto truth = test::truthShape(scene.shape, kWidth, kHeight);
  Recipe recipe;
  recipe.construct.method = scene.method;
  recipe.construct.light = false;
  recipe.corners.automatic = false;
  recipe.fairing.mode = scene.mode;
  recipe.fairing.targets.spans = TargetSpans::Whole;
  for (std::size_t i = 0; i < truth.corners.size(); ++i) {
    recipe.cornerMarks.push_back({truth.corners[i] + Vec2(i % 2 == 0 ? 4.0 : -4.0, 3.0)});
  }
  StageCache cache;
  const auto out = runPipeline(render(scene, truth), recipe, cache, {}, {});
  ASSERT_FALSE(out.error) << out.error->message;
  const json actual = figuresOf(truth, out);
  std::ifstream file(std::string(BATTEN_GOLDEN_EXPECTED "/") + scene.name + ".json");
  const json expected = file ? json::parse(file) : json::object();
  EXPECT_EQ(expected.size(), actual.size()) << "figures without an expected value";
  for (const auto& [figure, bounds] : expected.items()) {
    ASSERT_TRUE(actual.contains(figure)) << figure;
    EXPECT_NEAR(actual[figure].get<double>(), bounds.at("value").get<double>(), bounds.at("tolerance").get<double>())
        << figure;
  }
  if (::testing::Test::HasFailure())
    std::ofstream(std::string(BATTEN_GOLDEN_ACTUAL "/") + scene.name + ".actual.json") << actual.dump(1) << '\n';
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Golden,
    ::testing::Values(Scene{"ellipse-nurbs", "ellipse", false, ConstructMethod::Nurbs, FairingMode::None},
                      Scene{"ellipse-faired", "ellipse", false, ConstructMethod::Nurbs, FairingMode::Tolerance},
                      Scene{"ellipse-stroke", "ellipse", true, ConstructMethod::Fair, FairingMode::None},
                      Scene{"car-nurbs", "car", false, ConstructMethod::Nurbs, FairingMode::None},
                      Scene{"car-fair", "car", false, ConstructMethod::Fair, FairingMode::None},
                      Scene{"letter-k", "K", false, ConstructMethod::Fair, FairingMode::None}),
    [](const auto& scene) {
      std::string name = scene.param.name;
      std::erase(name, '-');
      return name;
    });

}  // namespace
}  // namespace batten
