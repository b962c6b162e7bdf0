// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/structure/structure_candidates.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/curve/curvature.h"
#include "core/fairing/model/coarse_setups.h"
#include "core/fairing/model/fairing_state.h"
#include "core/fairing/model/sketch_deviation.h"

namespace batten {
namespace {

/// [extents] Moves that the search is scaled for.
constexpr double kLeastStep = 1e-3;
/// A start over fewer knots that lies so many tolerances off is not looked at.
constexpr double kWorthOpening = 2.0;
/// A structure whose estimated move, good to a factor of a few, is so many tolerances is not tried; over all knots of
/// the sketch, where it takes longest and finds least, not beyond one.
constexpr double kWorthTrying = 3.0, kWorthTryingOnSketch = 1.0;
/// Bounds on the distance, each this share of what the one before reached.
constexpr double kTighter = 0.75;
constexpr int kMostBounds = 4;  // limits the work
/// The distance is bounded at the samples: some of it is left for what lies between them.
constexpr double kBoundShare = 0.985;
/// A nearest curve (in the mean) that lies farther off than so many times what is wanted is not tried with bounds:
/// 1 / (kTighter * kBoundShare)^kMostBounds.
constexpr double kWorthBounding = 3.4;
/// Over more spans than this not every structure is tried, but every one with about a sixth fewer extrema.
constexpr int kManySpans = 48;
constexpr double kThinning = 6.0;  // one in so many
/// Over this many spans more, a wanted number of extrema is looked for over fewer knots only.
constexpr int kLongSpans = 200;

int sizeOf(const CurvatureStructure& structure) { return static_cast<int>(structure.extrema.size()); }

}  // namespace

bool isTruerThan(const StructureCandidate& a, const StructureCandidate& b, int asked) {
  const int allA = std::max(a.allExtrema, asked), allB = std::max(b.allExtrema, asked);
  return allA != allB ? allA < allB : a.deviationMm < b.deviationMm;
}

bool isFairerThan(const StructureCandidate& a, const StructureCandidate& b) {
  return a.extrema != b.extrema ? a.extrema < b.extrema : isTruerThan(a, b, 0);
}

Result<FairedCurve> asFaired(const FairingSetup& sketch, const StructureCandidate& found, FairingReport report) {
  auto curve = toCurve(*found.setup, found.points);
  if (!curve) return fail(curve.error());
  const FairingObjective even;
  const auto before = evaluate(sketch, even, {}, sketch.points, sketch.start.places);
  const auto after = evaluate(*found.setup, even, {}, found.points, sketch.start.places);
  report.objectiveBefore = before ? before->misfit : 0.0;
  report.objectiveAfter = after ? after->misfit : report.objectiveBefore;
  report.maxDeviationMm = found.deviationMm;
  report.extremaBefore = countedExtrema(sketch.original, sketch.closed, sketch.check);
  report.extremaAfter = found.extrema;
  return FairedCurve{std::move(*curve), std::move(report)};
}

StructureCandidates::StructureCandidates(std::shared_ptr<const FairingSetup> sketch, const RunContext& context)
    : sketch_(std::move(sketch)), context_(context) {
  for (auto& setup : coarseSetups(sketch_)) bases_.push_back({std::move(setup), nullptr, {}, {}});
  bases_.push_back({sketch_, nullptr, {}, {}});
  if (open(bases_.size() - 1).levels.empty()) bases_.clear();
}

StructureCandidates::Basis& StructureCandidates::open(std::size_t at) {
  Basis& basis = bases_[at];
  if (basis.search) return basis;
  basis.search = std::make_unique<MonotoneSearch>(*basis.setup, kLeastStep * sketch_->extent, context_);
  if (basis.search->arcLength().empty()) return basis;
  basis.levels = structureLevels(basis.search->arcLength(), basis.search->curvature(), basis.setup->start.length,
                                 basis.setup->closed, context_);
  if (auto start = candidate(basis, basis.setup->points)) {
    basis.start = std::move(*start);
  } else {
    basis.levels.clear();
  }
  return basis;
}

std::optional<StructureCandidate> StructureCandidates::candidate(const Basis& basis, std::vector<Vec2> points) const {
  const auto curve = toCurve(*basis.setup, points);
  if (!curve) return std::nullopt;
  StructureCandidate result{
      basis.setup, {}, countedExtrema(*curve, sketch_->closed, context_), 0.0, basis.search->countAllExtrema(points)};
  result.points = std::move(points);
  if (basis.setup != sketch_ || result.points != sketch_->points)
    result.deviationMm = largestDeviation(*basis.setup, result.points, true);
  return result;
}

StructureCandidate StructureCandidates::overSketch(std::vector<Vec2> points, int extrema, double deviationMm) const {
  const int allExtrema = bases_.back().search->countAllExtrema(points);
  return {sketch_, std::move(points), extrema, deviationMm, allExtrema};
}

/// Simplest first.
std::vector<std::size_t> StructureCandidates::levelsToTry(const Basis& basis) const {
  std::vector<std::size_t> result;
  const bool many = basis.setup->basis.spanCount() > kManySpans;
  double next = 0.0;
  for (std::size_t i = basis.levels.size(); i-- > 0;) {
    const int size = sizeOf(basis.levels[i].structure);
    if (many && size < next) continue;
    result.push_back(i);
    next = size + size / kThinning;
  }
  return result;
}

std::optional<StructureCandidate> StructureCandidates::solved(const Basis& basis, const CurvatureStructure& structure,
                                                              double estimateMm, std::optional<double> giveUpMm) {
  auto outcome = basis.search->solve(structure, basis.setup->points, estimateMm, {.giveUpMm = giveUpMm});
  iterations_ += outcome.iterations;
  if (!outcome.found || context_.isCancelled()) return std::nullopt;
  auto found = candidate(basis, std::move(outcome.points));
  if (!found || (giveUpMm && found->deviationMm > *giveUpMm)) return std::nullopt;
  return found;
}

StructureCandidate StructureCandidates::closer(const Basis& basis, const CurvatureStructure& structure,
                                               StructureCandidate found, int mostExtrema) {
  for (int i = 0; i < kMostBounds && !context_.isCancelled(); ++i) {
    const double bound = kTighter * found.deviationMm;
    auto outcome = basis.search->solve(structure, found.points, found.deviationMm, {.boundMm = kBoundShare * bound});
    iterations_ += outcome.iterations;
    if (!outcome.found) break;
    auto nearer = candidate(basis, std::move(outcome.points));
    if (!nearer || nearer->extrema > mostExtrema) break;
    if (nearer->deviationMm > 0.5 * (1.0 + kTighter) * found.deviationMm) break;
    found = std::move(*nearer);
  }
  return found;
}

StructureCandidate StructureCandidates::fewest(double toleranceMm, std::optional<int> moreThan) {
  const auto isTooFew = [&](int extrema) { return moreThan && extrema <= *moreThan; };
  StructureCandidate best = open(bases_.size() - 1).start;
  const int sketched = best.extrema;
  const auto offer = [&](StructureCandidate found) {
    if (found.deviationMm > toleranceMm || isTooFew(found.extrema)) return;
    if (found.extrema == sketched && best.extrema == sketched) return;
    if (isFairerThan(found, best)) best = std::move(found);
  };
  // Bounds on the distance change neither the small extrema nor, but rarely, the others.
  const auto mayWin = [&](const StructureCandidate& found) {
    if (found.extrema < best.extrema || found.allExtrema < best.allExtrema) return true;
    return found.allExtrema == best.allExtrema && found.deviationMm < kWorthBounding * best.deviationMm;
  };
  for (std::size_t at = 0; at < bases_.size() && !context_.isCancelled(); ++at) {
    Basis& basis = open(at);
    if (basis.levels.empty() || basis.start.deviationMm > kWorthOpening * toleranceMm) continue;
    const double worth = (basis.setup == sketch_ ? kWorthTryingOnSketch : kWorthTrying) * toleranceMm;
    offer(basis.start);
    for (const std::size_t level : levelsToTry(basis)) {
      const StructureLevel& tried = basis.levels[level];
      if (context_.isCancelled() || sizeOf(tried.structure) > best.extrema) break;
      if (tried.estimateMm > worth || isTooFew(sizeOf(tried.structure))) continue;
      auto found = solved(basis, tried.structure, tried.estimateMm, kWorthBounding * toleranceMm);
      if (!found) continue;
      if (found->deviationMm > toleranceMm || mayWin(*found)) found = closer(basis, tried.structure, std::move(*found));
      if (found->deviationMm > toleranceMm || isTooFew(found->extrema)) continue;
      offer(std::move(*found));
      break;
    }
  }
  return best;
}

template <class Structures>
std::optional<StructureCandidate> StructureCandidates::nearestOf(int most, const Structures& structuresOf) {
  struct Found {
    StructureCandidate curve;
    const Basis* basis;
    CurvatureStructure structure;
  };
  std::vector<Found> all;
  for (std::size_t at = 0; at < bases_.size() && !context_.isCancelled(); ++at) {
    Basis& basis = open(at);
    if (basis.levels.empty()) continue;
    if (!all.empty() && basis.setup == sketch_ && basis.setup->basis.spanCount() > kLongSpans) continue;
    for (StructureLevel& tried : structuresOf(basis)) {
      auto found = solved(basis, tried.structure, tried.estimateMm, std::nullopt);
      if (found && found->extrema <= most) all.push_back({std::move(*found), &basis, std::move(tried.structure)});
    }
  }
  const auto isNearer = [](const Found& a, const Found& b) { return a.curve.deviationMm < b.curve.deviationMm; };
  std::stable_sort(all.begin(), all.end(), isNearer);
  std::optional<StructureCandidate> best;
  for (Found& one : all) {
    if (best && one.curve.deviationMm > kWorthBounding * best->deviationMm) break;
    StructureCandidate nearest = closer(*one.basis, one.structure, std::move(one.curve), most);
    if (!best || nearest.deviationMm < best->deviationMm) best = std::move(nearest);
  }
  return best;
}

std::optional<StructureCandidate> StructureCandidates::nearest(int extrema) {
  const StructureCandidate& sketch = bases_.back().start;
  if (sketch.extrema <= extrema) return sketch;
  auto best = nearestOf(extrema, [&](const Basis& basis) {
    std::size_t level = 0;
    while (level + 1 < basis.levels.size() && sizeOf(basis.levels[level].structure) > extrema) ++level;
    // One more of the curvature may be too small to count.
    const std::size_t first = level > 0 ? level - 1 : level;
    return std::vector(&basis.levels[first], &basis.levels[level] + 1);
  });
  for (const Basis& basis : bases_) {
    if (basis.levels.empty() || basis.start.extrema > extrema) continue;
    if (!best || basis.start.deviationMm < best->deviationMm) best = basis.start;
  }
  return best;
}

std::optional<StructureCandidate> StructureCandidates::nearestWith(const std::vector<double>& keptAt) {
  return nearestOf(std::numeric_limits<int>::max(), [&](const Basis& basis) {
    std::vector<int> samples;
    const auto& s = basis.search->arcLength();
    for (const double f : keptAt) {
      const auto above = std::lower_bound(s.begin(), s.end(), f * basis.setup->start.length);
      samples.push_back(static_cast<int>(std::min(above, s.end() - 1) - s.begin()));
    }
    return std::vector{StructureLevel{
        structureAt(basis.search->curvature(), basis.levels.front().structure, samples, basis.setup->closed),
        basis.levels.back().estimateMm}};
  });
}

}  // namespace batten
