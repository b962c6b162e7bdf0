// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_structure.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <utility>

#include "core/base/statistics.h"
#include "core/construct/typical/typical_path_feet.h"
#include "core/construct/typical/typical_path_fit.h"

namespace batten {

namespace {

constexpr std::size_t kMostElements = 60;  // of a path that is still divided: a fit solves dense equations
/// Points nearer than this to the path are near enough: what scans can tell at best.
constexpr double kFloor = 0.04;
/// [chi2] An extremum that costs less to remove goes.
constexpr double kExtremumCost = 20.0;
constexpr double kTurnCost = 8.0;  // [chi2] of each turn of the curvature at a joint
/// Steps of a fit: of a change that is only tried, of one that divides, of one that is to be kept or refused, and of
/// the last one, which is to come to rest.
constexpr int kTriedSteps = 12, kDividingSteps = 15, kKeptSteps = 25, kRestingSteps = 60;
/// Divisions that are tried of a rough path, and once more after its extrema are settled: they bound the time, as every
/// one is a fit.
constexpr int kMostDivisions = 24, kMostLateDivisions = 6;
/// Segments that go because their neighbours have consumed them: no more, however a path degenerates.
constexpr int kMostSlivers = 8;
/// Divisions in a row that bring nothing end the search, and extrema that are questioned at most.
constexpr int kMostFailures = 3, kMostQuestioned = 40;
/// Passes in which segments may change their kind or join.
constexpr int kPasses = 3;
/// Neighbouring points averaged to tell a systematic misfit: at least so many, and a part of those of the element.
constexpr std::size_t kFewestAveraged = 6, kGroups = 5;
/// Stretches along which the curvature changes more than e to this are not questioned.
constexpr double kSureRise = 1.2;

/// Noise of the points: no less, however well they lie.
constexpr double kLeastNoise = 0.05;
/// Points farther off than this many robust standard deviations count less, which are no less than this.
constexpr double kOutlierSigmas = 5.0, kLeastOutlierSigma = 0.1;
/// Of the mean square of the path: an element whose systematic misfit is less (twice the rms) is not divided.
constexpr double kSystematicMisfit = 4.0;
/// [parameter] An element is not divided nearer to its ends, and an extremum nearer to them is none inside.
constexpr double kDivideFrom = 0.2, kInsideFrom = 0.05;
/// [rad] Half the change of direction of one curve in place of two.
constexpr double kMostJoinedTurn = 0.7;

/// How much of the misfit of each element is systematic: squared means of groups of neighbouring points.
std::vector<double> systematicMisfit(const TypicalPath& path, const PathFit& fit) {
  std::vector<std::vector<double>> byElement(path.elements.size());
  for (const PathFoot& foot : fit.feet) byElement[foot.element].push_back(foot.distance);
  std::vector<double> result;
  for (const auto& distances : byElement) {
    const std::size_t size = std::max(kFewestAveraged, distances.size() / kGroups);
    double sum = 0.0;
    for (std::size_t i = 0; i + size <= distances.size(); i += size) {
      double mean = 0.0;
      for (std::size_t k = i; k < i + size; ++k) mean += distances[k];
      sum += mean * mean / static_cast<double>(size) - fit.rms * fit.rms;
    }
    result.push_back(sum);
  }
  return result;
}

class StructureSearch {
 public:
  StructureSearch(PathData data, const RunContext& context) : data_(std::move(data)), context_(context) {}

  std::optional<FittedPath> run(TypicalPath path, PathSearch search) {
    const bool divide = search == PathSearch::Full, doubts = divide || search == PathSearch::Tidy;
    auto first = refit(std::move(path), kKeptSteps);
    if (!first) return std::nullopt;
    now_ = std::move(*first);
    watchOutliers();
    if (divide) divideWhereNeeded(kMostDivisions);
    if (search != PathSearch::Simplify && !holdMonotone(doubts)) return std::nullopt;
    if (doubts) dropExtrema();
    if (divide) divideWhereNeeded(kMostLateDivisions);
    if (search != PathSearch::Keep) {
      simplify(doubts);
      dissolveSlivers();
    }
    comeToRest();
    if (search != PathSearch::Keep) dissolveSlivers();
    if (context_.isCancelled()) return std::nullopt;
    now_.fit.noise = data_.noise;
    return std::move(now_);
  }

 private:
  /// The fits in between are cut short: they only have to tell which path is the better one.
  void comeToRest() {
    if (now_.fit.converged || context_.isCancelled()) return;
    if (auto rested = refit(now_.path, kRestingSteps)) now_ = std::move(*rested);
  }

  /// Bayesian information; a turn of the curvature at a joint has to be worth more than its unknowns.
  static double score(const FittedPath& fitted) {
    const auto& [path, fit] = fitted;
    const double n = static_cast<double>(std::max<std::size_t>(4, fit.feet.size()));
    const double mean = fit.cost / n;
    int turns = 0;
    for (std::size_t s = 1; s + 1 < path.states.size(); ++s) {
      const double before = path.states[s].kappa - path.states[s - 1].kappa;
      turns += before * (path.states[s + 1].kappa - path.states[s].kappa) < 0.0 ? 1 : 0;
    }
    return n * std::log(mean + kFloor * kFloor) + fit.unknowns * std::log(n) + kTurnCost * turns;
  }

  /// Points that lie far off count less from now on.
  void watchOutliers() {
    std::vector<double> sizes;
    for (const PathFoot& foot : now_.fit.feet) sizes.push_back(std::abs(foot.distance));
    if (sizes.empty()) return;
    const double typical = robustSigma(sizes);
    data_.noise = std::max(typical, kLeastNoise);
    data_.outlier = kOutlierSigmas * std::max(typical, kLeastOutlierSigma);
  }

  std::optional<FittedPath> refit(TypicalPath path, int iterations) const {
    return fitPath(std::move(path), data_, iterations, context_);
  }

  void divideWhereNeeded(int most) {
    std::set<std::size_t> tried;
    int failures = 0;
    for (int i = 0; i < most && failures < kMostFailures && now_.path.elements.size() < kMostElements; ++i) {
      if (context_.isCancelled() || now_.fit.rms < kFloor) return;
      const auto misfit = systematicMisfit(now_.path, now_.fit);
      std::optional<std::size_t> worst;
      for (std::size_t e = 0; e < misfit.size(); ++e) {
        if (tried.contains(e) || misfit[e] < kSystematicMisfit * now_.fit.rms * now_.fit.rms) continue;
        if (!worst || misfit[e] > misfit[*worst]) worst = e;
      }
      if (!worst) return;
      TypicalPath divided = now_.path;
      divided.split(*worst, placeToDivide(*worst));
      auto fitted = refit(std::move(divided), kDividingSteps);
      if (fitted && score(*fitted) < score(now_)) {
        now_ = std::move(*fitted);
        watchOutliers();
        tried.clear();
        failures = 0;
      } else {
        tried.insert(*worst);
        ++failures;
      }
    }
  }

  /// In the middle of its points.
  double placeToDivide(std::size_t e) const {
    std::vector<double> t;
    for (const PathFoot& foot : now_.fit.feet) {
      if (foot.element == e) t.push_back(foot.t);
    }
    return t.empty() ? 0.5 : std::clamp(t[t.size() / 2], kDivideFrom, 1.0 - kDivideFrom);
  }

  bool holdMonotone(bool divide) {
    for (std::size_t e = 0; e < now_.path.elements.size(); ++e) {
      if (!now_.path.elements[e].typical) continue;
      const double top = placeOfMaximum(now_.path.elements[e]);
      if (divide && !now_.path.elements[e].isMonotone() && top > kInsideFrom && top < 1.0 - kInsideFrom) {
        now_.path.split(e, top);
        now_.path.elements[e].setTrend(Trend::Rising);
        now_.path.elements[++e].setTrend(Trend::Falling);
        continue;
      }
      now_.path.elements[e].setTrend(now_.path.elements[e].logRatio() < 0.0 ? Trend::Rising : Trend::Falling);
    }
    auto fitted = refit(std::move(now_.path), kKeptSteps);
    if (!fitted) return false;
    now_ = std::move(*fitted);
    return true;
  }

  /// Neighbouring segments with one trend.
  struct Stretch {
    std::vector<std::size_t> elements;
    double rise = 0.0;
    bool hasNeighbour = false;
  };
  std::vector<Stretch> stretches() const {
    std::vector<Stretch> all;
    for (std::size_t e = 0; e < now_.path.elements.size(); ++e) {
      const PathElement& one = now_.path.elements[e];
      if (!one.typical) continue;
      const bool follows = e > 0 && now_.path.elements[e - 1].typical;
      if (!follows || now_.path.elements[e - 1].trend != one.trend) {
        all.emplace_back();
        all.back().hasNeighbour = follows;
        if (follows) all[all.size() - 2].hasNeighbour = true;
      }
      all.back().elements.push_back(e);
      all.back().rise += 4.0 * std::abs(one.logRatio());
    }
    const bool around =
        now_.path.closed && all.size() > 1 && now_.path.elements.front().typical && now_.path.elements.back().typical;
    if (around && now_.path.elements.front().trend == now_.path.elements.back().trend) {
      for (const std::size_t e : all.back().elements) all.front().elements.push_back(e);
      all.front().rise += all.back().rise;
      all.pop_back();
    }
    return all;
  }

  void dropExtrema() {
    std::set<std::size_t> kept;
    for (int i = 0; i < kMostQuestioned && !context_.isCancelled(); ++i) {
      auto all = stretches();
      std::erase_if(all, [&](const Stretch& s) {
        return !s.hasNeighbour || s.rise > kSureRise || kept.contains(s.elements.front());
      });
      if (all.empty()) return;
      const auto least = std::min_element(all.begin(), all.end(), [](auto& a, auto& b) { return a.rise < b.rise; });
      TypicalPath plain = now_.path;
      for (const std::size_t e : least->elements) {
        const bool rising = plain.elements[e].trend == Trend::Rising;
        plain.elements[e].setTrend(rising ? Trend::Falling : Trend::Rising);
      }
      const double points = static_cast<double>(std::max<std::size_t>(1, now_.fit.feet.size()));
      const double noise = std::max(now_.fit.cost / points, kFloor * kFloor);
      auto fitted = refit(std::move(plain), kKeptSteps);
      if (fitted && fitted->fit.cost - now_.fit.cost < kExtremumCost * noise) {
        now_ = std::move(*fitted);
      } else {
        kept.insert(least->elements.front());
      }
    }
  }

  /// Tries what makes the path plainer, element by element, until nothing is worth it any more: a typical curve for a
  /// Hermite piece that bends one way, one element for two.
  /// @param kinds also changes the kind of elements; else only typical curves of one trend are joined.
  void simplify(bool kinds) {
    for (int pass = 0; pass < kPasses && !context_.isCancelled(); ++pass) {
      bool changed = false;
      for (std::size_t e = 0; kinds && e < now_.path.elements.size(); ++e) {
        if (tryChange([&](TypicalPath& path) { return path.makeTypical(e); })) changed = true;
      }
      for (std::size_t e = 0; e + 1 < now_.path.elements.size();) {
        const PathElement &one = now_.path.elements[e], &next = now_.path.elements[e + 1];
        const bool both = one.typical && next.typical;
        const bool done = both ? one.trend == next.trend && one.turn() + next.turn() < kMostJoinedTurn &&
                                     tryChange([&](TypicalPath& path) { return path.join(e); })
                               : kinds && tryChange([&](TypicalPath& path) { return path.joinAsHermite(e); });
        changed = changed || done;
        if (!done) ++e;
      }
      if (!changed) return;
    }
  }

  /// A segment that its neighbours have all but consumed goes.
  void dissolveSlivers() {
    for (int i = 0; i < kMostSlivers && !context_.isCancelled(); ++i) {
      const auto sliver = firstSliver(now_.path);
      if (!sliver) return;
      auto without = withoutElement(now_.path, *sliver);
      if (!without) return;
      auto fitted = refit(std::move(*without), kKeptSteps);
      if (!fitted) return;
      now_ = std::move(*fitted);
    }
  }

  /// Its neighbour takes an element over: a typical one as such, else as a Hermite piece.
  static std::optional<TypicalPath> withoutElement(const TypicalPath& path, std::size_t e) {
    const bool hasNext = e + 1 < path.elements.size();
    for (const bool asTypical : {true, false}) {
      for (const bool isNext : {true, false}) {
        if (isNext ? !hasNext : e == 0) continue;
        TypicalPath joined = path;
        const std::size_t neighbour = isNext ? e + 1 : e - 1, first = std::min(e, neighbour);
        joined.elements[e].trend = joined.elements[neighbour].trend;
        if (asTypical ? joined.join(first) : joined.joinAsHermite(first)) return joined;
      }
    }
    return std::nullopt;
  }

  template <class Change>
  bool tryChange(const Change& change) {
    TypicalPath plain = now_.path;
    if (context_.isCancelled() || !change(plain)) return false;
    auto fitted = refit(std::move(plain), kTriedSteps);
    if (!fitted || !(score(*fitted) < score(now_))) return false;
    now_ = std::move(*fitted);
    return true;
  }

  PathData data_;
  const RunContext& context_;
  FittedPath now_;
};

}  // namespace

double placeOfMaximum(const PathElement& e) {
  // 1 - t + t z is shortest there.
  const std::complex<double> z = std::polar(std::exp(e.logRatio()), e.turn());
  return (1.0 - z).real() / std::norm(z - 1.0);
}

std::optional<FittedPath> fitTypicalStructure(TypicalPath path, PathData data, PathSearch search,
                                              const RunContext& context) {
  return StructureSearch(std::move(data), context).run(std::move(path), search);
}

}  // namespace batten
