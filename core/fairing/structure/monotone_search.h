// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
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
    std::vector<Vec2> points;
    bool found = false;        ///< Sampled densely, the curvature turns back at the structure's extrema only.
    double deviationMm = 0.0;  ///< From the sketch, both ways.
    int iterations = 0;
  };
  /// @param estimateMm about how far the curve will move: scales the problem.
  /// @param boundMm > 0: the distance from the sketch is bounded.
  /// @param giveUpMm > 0: a curve that goes farther than this is not looked for to its end (not found).
  Outcome solve(CurvatureStructure structure, const std::vector<Vec2>& start, double estimateMm, double boundMm,
                double giveUpMm) const;

  /// Turns of the curvature of the curve over `points`, sampled densely.
  int denseTurns(const std::vector<Vec2>& points) const;

 private:
  struct State;
  struct Window {
    int low = 0, high = 0;
    bool maximum = true;
  };
  struct Scales {
    double distance = 1.0, margin = 0.0, bound = 0.0;
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
  std::vector<SpanPlace> places_, sketched_;  ///< The places, and about where on the sketch they lie.
  SpanCurve start_;                           ///< The curve to begin with.
  std::vector<double> s_, kappa_;
  double wave_ = 1.0;  ///< [mm] cut-off of the term against staircases.
  double flat_ = 0.0;  ///< [1/mm] what counts as no change of curvature.
};

}  // namespace batten
