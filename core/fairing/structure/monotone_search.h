// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/curve/curvature_structure.h"
#include "core/curve/span_curve.h"
#include "core/fairing/model/fairing_setup.h"

namespace batten {

/// The curve nearest to a sketched one whose curvature has a given structure: sequential quadratic programs over the
/// control points (fair-fit's monotone program on the curve itself). Minimised is the mean square distance from the
/// sketch plus a little of the integral of kappa''^2, which only takes waves shorter than a few knot spans and keeps
/// the result from becoming a staircase where the constraints act.
class MonotoneSearch {
 public:
  /// @param leastMoveMm > 0: the problem is scaled for moves of this size and more.
  MonotoneSearch(const FairingSetup& setup, double leastMoveMm, const RunContext& context);

  /// Arc length and curvature of the sketch at the places where constraints act; empty for a curve with a cusp.
  const std::vector<double>& arcLength() const { return s_; }
  const std::vector<double>& curvature() const { return kappa_; }

  struct Outcome {
    std::vector<Vec2> points;  ///< Control points. [mm]
    bool found = false;        ///< Sampled densely, the curvature turns back at the structure's extrema only.
    double deviationMm = 0.0;  ///< From the sketch, both ways.
    int iterations = 0;
  };
  /// Of the distance from the sketch.
  struct Limits {
    std::optional<double> boundMm = {};   ///< No curve goes farther.
    std::optional<double> giveUpMm = {};  ///< A curve that goes farther is not looked for to its end (not found).
  };
  /// @param estimateMm about how far the curve will move: scales the problem.
  Outcome solve(CurvatureStructure structure, const std::vector<Vec2>& start, double estimateMm,
                const Limits& limits) const;

  /// Extrema of the curvature of the curve over `points`, sampled densely: all, however small.
  int countAllExtrema(const std::vector<Vec2>& points) const;

 private:
  /// The curve on its way at one of the places.
  struct Sample {
    Jet jet;
    CurvatureJet curvature;
    SpanPlace foot;                                      ///< On the sketch.
    Vec2 normal = Vec2::Zero(), tangent = Vec2::Zero();  ///< Of the sketch there.
    double distance = 0.0, slide = 0.0;                  ///< [mm] From the foot across; from the start along it.
    double step = 0.0;                                   ///< [mm] Arc length to the next place.
    double weight = 0.0;                                 ///< Arc length that the place stands for, in mean spans.
  };
  struct State;
  struct Window {
    int low = 0, high = 0;
    bool maximum = true;
  };
  struct Scales {
    double distance = 1.0, margin = 0.0;
    std::optional<double> bound;
  };
  class Program;

  State evaluate(const std::vector<Vec2>& points, const std::vector<SpanPlace>& feet) const;
  std::vector<Window> windows(const CurvatureStructure& structure) const;
  void recentre(CurvatureStructure& structure, const std::vector<Window>& windows, const State& state) const;
  void addDistance(Program& program, const State& state, const Scales& scales) const;
  void addBend(Program& program, const State& state, const Scales& scales) const;
  void addSigns(Program& program, const State& state, const CurvatureStructure& structure, const Scales& scales) const;
  int wrapped(int sample) const;

  const FairingSetup& setup_;
  double leastMoveMm_;
  const RunContext& context_;
  SpanCurve start_;                 ///< The curve to begin with.
  std::vector<SpanPlace> counted_;  ///< Where extrema are counted.
  // By place. Not one struct a place: programs take all places, evaluate() all feet, structures all lengths and
  // curvatures.
  std::vector<SpanPlace> places_, sketched_;  ///< The places, and about where on the sketch they lie.
  std::vector<double> s_, kappa_;
  double wave_ = 1.0;  ///< [mm] cut-off of the term against staircases.
  double flat_ = 0.0;  ///< [1/mm] what counts as no change of curvature.
};

}  // namespace batten
