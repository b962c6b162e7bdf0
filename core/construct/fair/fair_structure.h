// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/construct/fair/fair_posterior.h"

namespace batten {

/// A curvature extremum as the fit sees it: px, 1/px, y up.
struct FairExtremum {
  double u = 0.0;           ///< Parameter in the frame (about arc length).
  double halfWidth = 16.0;  ///< [px] it may move within u +- halfWidth.
  double stretch = 60.0;    ///< [px] half of the stretch over which the unconstrained fit bends this way.
  bool maximum = true;
  double kappa = 0.0;
  int id = 0;
  double removalCost = 0.0;  ///< [chi2] known so far; a lower bound when its quadratic program was cut short.
  bool costKnown = false;
  int constraint = -1;  ///< Id of the user's constraint for it, -1 = none.
};

/// The user's constraint for the extremum nearest to a parameter of the frame.
struct PlacedConstraint {
  double u = 0.0;
  bool keep = true;
  int id = 0;
};

/// Which extrema a curve has, in order. Without extrema (open only) `rising` says whether the curvature rises.
struct FairStructure {
  std::vector<FairExtremum> extrema;
  bool rising = true;
  /// [1/px^2] The curvature rises or falls at least this much away from the extrema, per stretch between them (closed:
  /// the first one ends at the first extremum; open: and one after the last). Empty: it need not.
  std::vector<double> leastSlope = {};
};

struct StructureResult {
  FairStructure structure;
  std::vector<FairExtremum> dropped;  ///< Of the local extrema worth a test.
  std::vector<int> unmetConstraints;  ///< Constraints that found no extremum, or one that cannot go.
  Eigen::VectorXd c;                  ///< Offsets under the structure.
  double objective = 0.0;             ///< Penalised chi2 of c.
  double kappaSigma = 0.0;            ///< [1/px] median standard deviation of the curvature.
  bool limited = false;               ///< A quadratic program did not converge.
};

/// Drops curvature extrema, cheapest first, as long as the penalised chi2 rises by less than `keepCost` each. A
/// constraint belongs to the nearest extremum that was kept or dropped after a test: a kept one is never dropped, a
/// removed one goes whatever it costs, with its cheaper neighbour where it is not the only one at an end (closed curves
/// keep four). Absent when cancelled or when the first program cannot be solved.
std::optional<StructureResult> findStructure(const FairFrame&, const FairPosterior&, double keepCost,
                                             const std::vector<PlacedConstraint>&, const RunContext&);

/// Sets the half widths of the windows from the distances between extrema and their stretches.
void setWindows(FairStructure&, const UniformKnots&);

/// Minimum under a given structure: curvature monotone outside the windows, one extremum in each; windows follow their
/// extremum (updated). Absent when it cannot be solved.
struct StructureFit {
  Eigen::VectorXd c;
  double rise = 0.0;  ///< [chi2] of the objective over that of the start; a lower bound when aborted.
  bool aborted = false;
  bool converged = true;
};
/// @param start     offsets that the rise refers to and that hold outside the part that is solved for.
/// @param from,to   px; in long pieces only this part and 640 px on either side are solved for (from > to: all).
/// @param abortRise stops as soon as the rise is proven to exceed this.
std::optional<StructureFit> fitStructure(const FairFrame&, const FairPosterior&, FairStructure&,
                                         const Eigen::VectorXd& start, double from, double to, double abortRise);

/// Where the constraints of a structure act the curvature of `fit` is a staircase of plateaus. Asks every stretch for a
/// part of its mean slope all along, as far as that raises the penalised chi2 of the stretch by no more than noise is
/// (a line that was drawn with an arc in it keeps its arc), and solves again. Sets structure.leastSlope. Returns `fit`
/// where nothing can be had.
StructureFit withoutPlateaus(const FairFrame&, const FairPosterior&, FairStructure&, StructureFit fit);

/// Local extrema of the curvature under offsets c, with their stretches. Sets `rising`.
FairStructure localExtrema(const FairFrame&, const Eigen::VectorXd& c);
/// Curvature at a check station under c.
inline double kappaAt(const FrameStation& s, const Eigen::VectorXd& c) { return s.kappa + dot(s.kappaRow, c); }

}  // namespace batten
