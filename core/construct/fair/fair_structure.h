// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/base/run_context.h"
#include "core/construct/fair/fair_posterior.h"

namespace batten {

/// A curvature extremum as the fit sees it: px, 1/px, y up.
struct FairExtremum {
  double u = 0.0;           ///< Parameter in the frame (about arc length).
  double halfWidth = 16.0;  ///< [px] it may move within u +- halfWidth.
  double stretch = 60.0;    ///< [px] half of the stretch over which the unconstrained fit bends this way.
  bool maximum = true;
  double kappa = 0.0;  ///< [1/px] Signed curvature there.
  int id = 0;
  double removalCost = 0.0;       ///< [chi2] known so far; a lower bound when its quadratic program was cut short.
  bool costKnown = false;         ///< Whether `removalCost` was found.
  std::optional<int> constraint;  ///< Id of the user's constraint for it.
};

/// The user's constraint for the extremum nearest to a parameter of the frame.
struct PlacedConstraint {
  double u = 0.0;    ///< Parameter in the frame.
  bool keep = true;  ///< False: the extremum is to go.
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

/// [px] The largest half width of a window.
inline constexpr double kWidestWindowPx = 60.0;

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
/// A stretch of a piece [px]; closed: `to` may lie beyond the seam.
struct StructureStretch {
  double from = 0.0, to = 0.0;
};
/// How much of a structure is solved for.
struct StructureScope {
  /// In long pieces only this and 640 px on either side are solved for; absent: all.
  std::optional<StructureStretch> stretch = {};
  /// [chi2] Stops as soon as the rise is proven to exceed this.
  double abortRise = std::numeric_limits<double>::infinity();
};
/// @param start     offsets that the rise refers to and that hold outside the part that is solved for.
std::optional<StructureFit> fitStructure(const FairFrame&, const FairPosterior&, FairStructure&,
                                         const Eigen::VectorXd& start, const StructureScope&, CancelCheck);

/// Local extrema of the curvature under offsets c, with their stretches. Sets `rising`.
FairStructure localExtrema(const FairFrame&, const Eigen::VectorXd& c);
/// Curvature at a check station under c.
inline double kappaAt(const FrameStation& s, const Eigen::VectorXd& c) { return s.kappa + dot(s.kappaRow, c); }

}  // namespace batten
