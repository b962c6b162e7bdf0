// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/curve/curvature_structure.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/model/fairing_setup.h"
#include "core/fairing/structure/monotone_search.h"

namespace batten {

/// A curve that may be taken in place of the sketched one.
struct StructureCandidate {
  std::shared_ptr<const FairingSetup> setup;  ///< Over whose knots it is.
  std::vector<Vec2> points;
  int extrema = 0;           ///< Of the usual prominence.
  double deviationMm = 0.0;  ///< From the sketched curve, both ways.
  int turns = 0;             ///< Of the curvature, however small.
};

/// The candidate as a result: objective, extrema and deviation are filled in.
Result<FairedCurve> asFaired(const FairingSetup& sketch, const StructureCandidate& candidate, FairingReport report);

/// Curves with fewer curvature extrema than a sketched one: the nearest curve of every structure from the sketch's own
/// down to the simplest (MonotoneSearch), over the sketch's knots and over fewer. What is tried and found depends on
/// the sketch alone; a tolerance only says how much of it is looked at. So all that is found within a tolerance is
/// found within a larger one too, and what a number of extrema needs is one number.
class StructureCandidates {
 public:
  StructureCandidates(std::shared_ptr<const FairingSetup> sketch, const RunContext&);

  /// False for a curve with a cusp: there is nothing but the sketch.
  bool isValid() const { return !bases_.empty(); }
  /// The curve with the fewest extrema within the tolerance, and the nearest of those found; the sketch itself if need
  /// be.
  StructureCandidate fewest(double toleranceMm);
  /// The nearest curve found with no more extrema than these; none when none was found.
  std::optional<StructureCandidate> nearest(int extrema);
  /// The same with the extrema nearest to these shares of the arc length.
  std::optional<StructureCandidate> nearestWith(const std::vector<double>& keptAt);
  const std::shared_ptr<const FairingSetup>& sketch() const { return sketch_; }
  int iterations() const { return iterations_; }

 private:
  /// The structures over one knot vector.
  struct Basis {
    std::shared_ptr<const FairingSetup> setup;
    std::unique_ptr<MonotoneSearch> search;
    std::vector<StructureLevel> levels;
    StructureCandidate start;
  };
  Basis& open(std::size_t basis);
  std::vector<std::size_t> levelsToTry(const Basis& basis) const;
  std::optional<StructureCandidate> candidate(const Basis& basis, std::vector<Vec2> points) const;
  /// @param enoughMm the distance is bounded closer and closer until it is no larger than this; 0: as close as it goes.
  std::optional<StructureCandidate> solved(const Basis& basis, const CurvatureStructure& structure, double estimateMm,
                                           double enoughMm);
  std::optional<StructureCandidate> closer(const Basis& basis, const CurvatureStructure& structure,
                                           StructureCandidate found, double enoughMm);
  template <class Structure>
  std::optional<StructureCandidate> nearestOf(const Structure& structureOf);

  std::shared_ptr<const FairingSetup> sketch_;
  const RunContext& context_;
  std::vector<Basis> bases_;  ///< Fewest knots first, the sketch's own last.
  int iterations_ = 0;
};

}  // namespace batten
