// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_structure.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>

#include "core/base/statistics.h"
#include "core/construct/typical/typical_path_feet.h"
#include "core/construct/typical/typical_path_fit.h"

namespace batten {

namespace {

constexpr std::size_t kMostElements = 60;
/// Points nearer than this to the path are near enough: what scans can tell at best.
constexpr double kFloor = 0.04;
/// [chi2] An extremum that costs less to remove goes.
constexpr double kExtremumCost = 20.0;
constexpr double kTurnCost = 8.0;
/// Steps of a fit: of a change that is only tried, of one that divides, and of one that is to be kept or refused.
constexpr int kTriedSteps = 12, kDividingSteps = 15, kKeptSteps = 25;
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
  StructureSearch(TypicalPath& path, PathData& data, const RunContext& context)
      : path_(path), data_(data), context_(context) {}

  std::optional<PathFit> run(PathSearch search) {
    const bool divide = search == PathSearch::Full, doubts = divide || search == PathSearch::Tidy;
    auto first = fitPath(path_, data_, 25, context_);
    if (!first) return std::nullopt;
    fit_ = std::move(*first);
    watchOutliers();
    if (divide) divideWhereNeeded(24);
    if (search != PathSearch::Simplify && !holdMonotone(doubts)) return std::nullopt;
    if (doubts) dropExtrema();
    if (divide) divideWhereNeeded(6);
    if (search != PathSearch::Keep) {
      simplify(doubts);
      dissolveSlivers();
    }
    comeToRest();
    if (search != PathSearch::Keep) dissolveSlivers();
    return context_.isCancelled() ? std::nullopt : std::optional(fit_);
  }

 private:
  /// The fits in between are cut short: they only have to tell which path is the better one.
  void comeToRest() {
    constexpr int kIterations = 60;
    if (fit_.converged || context_.isCancelled()) return;
    TypicalPath path = path_;
    PathFit fit;
    if (!refit(path, fit, kIterations)) return;
    path_ = std::move(path);
    fit_ = std::move(fit);
  }

  /// Bayesian information; a turn of the curvature at a joint has to be worth more than its unknowns.
  static double score(const TypicalPath& path, const PathFit& fit) {
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
    for (const PathFoot& foot : fit_.feet) sizes.push_back(std::abs(foot.distance));
    if (sizes.empty()) return;
    const double typical = robustSigma(sizes);
    data_.noise = std::max(typical, kLeastNoise);
    data_.outlier = kOutlierSigmas * std::max(typical, kLeastOutlierSigma);
  }

  bool refit(TypicalPath& path, PathFit& fit, int iterations) {
    auto fitted = fitPath(path, data_, iterations, context_);
    if (!fitted) return false;
    fit = std::move(*fitted);
    return true;
  }

  void divideWhereNeeded(int most) {
    std::set<std::size_t> tried;
    int failures = 0;
    for (int i = 0; i < most && failures < kMostFailures && path_.elements.size() < kMostElements; ++i) {
      if (context_.isCancelled() || fit_.rms < kFloor) return;
      const auto misfit = systematicMisfit(path_, fit_);
      std::optional<std::size_t> worst;
      for (std::size_t e = 0; e < misfit.size(); ++e) {
        if (tried.contains(e) || misfit[e] < kSystematicMisfit * fit_.rms * fit_.rms) continue;
        if (!worst || misfit[e] > misfit[*worst]) worst = e;
      }
      if (!worst) return;
      TypicalPath divided = path_;
      divided.split(*worst, placeToDivide(*worst));
      PathFit fit;
      if (refit(divided, fit, kDividingSteps) && score(divided, fit) < score(path_, fit_)) {
        path_ = std::move(divided);
        fit_ = std::move(fit);
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
    for (const PathFoot& foot : fit_.feet) {
      if (foot.element == e) t.push_back(foot.t);
    }
    return t.empty() ? 0.5 : std::clamp(t[t.size() / 2], kDivideFrom, 1.0 - kDivideFrom);
  }

  bool holdMonotone(bool divide) {
    for (std::size_t e = 0; e < path_.elements.size(); ++e) {
      if (!path_.elements[e].typical) continue;
      const double top = placeOfMaximum(path_.elements[e]);
      if (divide && !path_.elements[e].isMonotone() && top > kInsideFrom && top < 1.0 - kInsideFrom) {
        path_.split(e, top);
        path_.elements[e].setTrend(Trend::Rising);
        path_.elements[++e].setTrend(Trend::Falling);
        continue;
      }
      path_.elements[e].setTrend(path_.elements[e].logRatio() < 0.0 ? Trend::Rising : Trend::Falling);
    }
    if (refit(path_, fit_, kKeptSteps)) return true;
    return false;
  }

  /// Neighbouring segments with one trend.
  struct Stretch {
    std::vector<std::size_t> elements;
    double rise = 0.0;
    bool hasNeighbour = false;
  };
  std::vector<Stretch> stretches() const {
    std::vector<Stretch> all;
    for (std::size_t e = 0; e < path_.elements.size(); ++e) {
      const PathElement& one = path_.elements[e];
      if (!one.typical) continue;
      const bool follows = e > 0 && path_.elements[e - 1].typical;
      if (!follows || path_.elements[e - 1].trend != one.trend) {
        all.emplace_back();
        all.back().hasNeighbour = follows;
        if (follows) all[all.size() - 2].hasNeighbour = true;
      }
      all.back().elements.push_back(e);
      all.back().rise += 4.0 * std::abs(one.logRatio());
    }
    const bool around =
        path_.closed && all.size() > 1 && path_.elements.front().typical && path_.elements.back().typical;
    if (around && path_.elements.front().trend == path_.elements.back().trend) {
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
      TypicalPath plain = path_;
      for (const std::size_t e : least->elements) {
        const bool rising = plain.elements[e].trend == Trend::Rising;
        plain.elements[e].setTrend(rising ? Trend::Falling : Trend::Rising);
      }
      PathFit fit;
      const double noise =
          std::max(fit_.cost / static_cast<double>(std::max<std::size_t>(1, fit_.feet.size())), kFloor * kFloor);
      if (refit(plain, fit, kKeptSteps) && fit.cost - fit_.cost < kExtremumCost * noise) {
        path_ = std::move(plain);
        fit_ = std::move(fit);
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
      for (std::size_t e = 0; kinds && e < path_.elements.size(); ++e) {
        if (tryChange([&](TypicalPath& path) { return path.makeTypical(e); })) changed = true;
      }
      for (std::size_t e = 0; e + 1 < path_.elements.size();) {
        const PathElement &one = path_.elements[e], &next = path_.elements[e + 1];
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
    constexpr int kMostSlivers = 8;
    for (int i = 0; i < kMostSlivers && !context_.isCancelled(); ++i) {
      const auto sliver = firstSliver(path_);
      if (!sliver) return;
      auto without = withoutElement(path_, *sliver);
      PathFit fit;
      if (!without || !refit(*without, fit, kKeptSteps)) return;
      path_ = std::move(*without);
      fit_ = std::move(fit);
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
    TypicalPath plain = path_;
    if (context_.isCancelled() || !change(plain)) return false;
    PathFit fit;
    if (!refit(plain, fit, kTriedSteps) || !(score(plain, fit) < score(path_, fit_))) return false;
    path_ = std::move(plain);
    fit_ = std::move(fit);
    return true;
  }

  TypicalPath& path_;
  PathData& data_;
  const RunContext& context_;
  PathFit fit_;
};

}  // namespace

double placeOfMaximum(const PathElement& e) {
  // 1 - t + t z is shortest there.
  const std::complex<double> z = std::polar(std::exp(e.logRatio()), e.turn());
  return (1.0 - z).real() / std::norm(z - 1.0);
}

std::optional<PathFit> fitTypicalStructure(TypicalPath& path, PathData& data, PathSearch search,
                                           const RunContext& context) {
  return StructureSearch(path, data, context).run(search);
}

}  // namespace batten
