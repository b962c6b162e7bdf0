// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/construct/fair/fair_structure.h"

namespace batten {

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

}  // namespace batten
