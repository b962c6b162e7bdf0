// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
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
  std::vector<Vec2> points;                   ///< Control points. [mm]
  int extrema = 0;                            ///< Of the usual prominence.
  double deviationMm = 0.0;                   ///< From the sketched curve, both ways.
  int allExtrema = 0;                         ///< However small: the curvature turns back there.
};

/// The candidate as a result: objective, extrema and deviation are filled in.
Result<FairedCurve> asFaired(const FairingSetup& sketch, const StructureCandidate& candidate, FairingReport report);

/// Of two curves with no more extrema than asked for: the one whose curvature turns back less often, however little
/// (so often as asked is seldom enough); of these the nearer one.
bool isTruerThan(const StructureCandidate& a, const StructureCandidate& b, int asked);
/// Fewer extrema; of equally many the truer one.
bool isFairerThan(const StructureCandidate& a, const StructureCandidate& b);

/// Curves with fewer curvature extrema than a sketched one: the nearest curve of every structure from the sketch's own
/// down to the simplest (MonotoneSearch), over the sketch's knots and over fewer. What is tried and found depends on
/// the sketch alone; a tolerance only says how much of it is looked at. So all that is found within a tolerance is
/// found within a larger one too, and what a number of extrema needs is one number.
class StructureCandidates {
 public:
  StructureCandidates(std::shared_ptr<const FairingSetup> sketch, const RunContext&);

  /// False for a curve with a cusp: there is nothing but the sketch.
  bool isValid() const { return !bases_.empty(); }
  /// The curve with the fewest extrema within the tolerance, and of equally many the truest; the sketch itself if need
  /// be.
  /// @param moreThan fewer than one more of them are not wanted.
  StructureCandidate fewest(double toleranceMm, std::optional<int> moreThan = {});
  /// The nearest curve found with no more extrema than these; none when none was found.
  std::optional<StructureCandidate> nearest(int extrema);
  /// The same with the extrema nearest to these shares of the arc length.
  std::optional<StructureCandidate> nearestWith(const std::vector<double>& keptAt);
  /// A curve over the sketch's knots that another search has found.
  StructureCandidate overSketch(std::vector<Vec2> points, int extrema, double deviationMm) const;
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
  /// The nearest curve in the mean.
  /// @param giveUpMm one that goes farther than this is none.
  std::optional<StructureCandidate> solved(const Basis& basis, const CurvatureStructure& structure, double estimateMm,
                                           std::optional<double> giveUpMm);
  /// Bounds the distance closer and closer, as far as that goes with at most so many extrema.
  StructureCandidate closer(const Basis& basis, const CurvatureStructure& structure, StructureCandidate found,
                            int mostExtrema = std::numeric_limits<int>::max());
  /// The nearest of the curves of some structures over each knot vector that have at most so many extrema.
  template <class Structures>
  std::optional<StructureCandidate> nearestOf(int most, const Structures& structuresOf);

  std::shared_ptr<const FairingSetup> sketch_;
  const RunContext& context_;
  std::vector<Basis> bases_;  ///< Fewest knots first, the sketch's own last.
  int iterations_ = 0;
};

}  // namespace batten
