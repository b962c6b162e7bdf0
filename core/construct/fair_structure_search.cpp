// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "core/construct/fair_structure.h"

namespace batten {
namespace {

constexpr double kPersistence = 1.0;  // standard deviations of kappa below which an extremum is not worth a test
constexpr double kCertain = 8.0;      // standard deviations above which the search stops
constexpr int kClosedLeast = 4;       // four vertex theorem
constexpr double kAbortFactor = 3.0;  // a program is cut short once its cost has passed this many thresholds

/// The removal of one extremum at an end, or of two neighbours.
struct Candidate {
  enum class Kind { First, Last, Pair } kind = Kind::Pair;
  std::size_t index = 0;  ///< Of the (first) extremum.
  double change = 0.0;    ///< [1/px] difference of curvature that disappears.
};

class Search {
 public:
  Search(const FairFrame& frame, const FairPosterior& posterior, double keepCost, const RunContext& context)
      : frame_(frame), posterior_(posterior), keepCost_(keepCost), context_(context) {
    closed_ = frame.base.knots().closed;
    std::vector<double> sigma;
    for (const FrameStation& s : frame.checks) {
      sigma.push_back(std::sqrt(std::max(0.0, BandCholesky::quadratic(posterior.covariance, s.kappaRow))));
    }
    const auto middle = sigma.begin() + static_cast<std::ptrdiff_t>(sigma.size() / 2);
    std::nth_element(sigma.begin(), middle, sigma.end());
    result_.kappaSigma = *middle;
  }

  std::optional<StructureResult> run() {
    result_.structure = localExtrema(frame_, posterior_.mean);
    simplify();
    auto fit = fitStructure(frame_, posterior_, result_.structure, posterior_.mean, 1.0, 0.0, kNever);
    if (!fit) return std::nullopt;
    result_.c = fit->c;
    result_.limited = !fit->converged;
    while (!result_.structure.extrema.empty()) {
      if (context_.isCancelled()) return std::nullopt;
      const auto next = cheapest(true);
      if (!next || (!tested_.empty() && next->change > kCertain * result_.kappaSigma)) break;
      tryRemoval(*next);
    }
    if (!priceTheRest()) return std::nullopt;
    result_.objective = posterior_.objective(result_.c);
    return std::move(result_);
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  std::pair<int, int> key(const Candidate& c) const {
    const auto& e = result_.structure.extrema;
    switch (c.kind) {
      case Candidate::Kind::First:
        return {-1, e[c.index].id};
      case Candidate::Kind::Last:
        return {e[c.index].id, -1};
      case Candidate::Kind::Pair:
        break;
    }
    return {e[c.index].id, e[(c.index + 1) % e.size()].id};
  }

  std::vector<Candidate> candidates(const Eigen::VectorXd& c) const {
    std::vector<Candidate> list;
    const auto& e = result_.structure.extrema;
    if (e.empty() || (closed_ && static_cast<int>(e.size()) <= kClosedLeast)) return list;
    for (std::size_t i = 0; i + 1 < e.size() + (closed_ ? 1 : 0); ++i) {
      list.push_back({Candidate::Kind::Pair, i, std::abs(e[i].kappa - e[(i + 1) % e.size()].kappa)});
    }
    if (!closed_) {
      const double atStart = kappaAt(frame_.checks.front(), c), atEnd = kappaAt(frame_.checks.back(), c);
      list.push_back({Candidate::Kind::First, 0, std::abs(e.front().kappa - atStart)});
      list.push_back({Candidate::Kind::Last, e.size() - 1, std::abs(e.back().kappa - atEnd)});
    }
    return list;
  }

  std::optional<Candidate> cheapest(bool untestedOnly) const {
    std::optional<Candidate> best;
    for (const Candidate& c : candidates(result_.c.size() > 0 ? result_.c : posterior_.mean)) {
      if (untestedOnly && tested_.count(key(c)) > 0) continue;
      if (!best || c.change < best->change) best = c;
    }
    return best;
  }

  static FairStructure without(const FairStructure& structure, const Candidate& c) {
    FairStructure rest = structure;
    auto& e = rest.extrema;
    const FairExtremum gone = e[c.index];
    switch (c.kind) {
      case Candidate::Kind::First:
        rest.rising = !gone.maximum;
        e.erase(e.begin());
        break;
      case Candidate::Kind::Last:
        rest.rising = gone.maximum;
        e.pop_back();
        break;
      case Candidate::Kind::Pair:
        rest.rising = gone.maximum;
        e.erase(e.begin() + static_cast<std::ptrdiff_t>(c.index));
        e.erase(e.begin() + static_cast<std::ptrdiff_t>(c.index % e.size()));
        break;
    }
    return rest;
  }

  /// Drops what lies within the noise of the curvature without any program, smallest first.
  void simplify() {
    for (;;) {
      const auto next = cheapest(false);
      if (!next || next->change >= kPersistence * result_.kappaSigma) return;
      result_.structure = without(result_.structure, *next);
    }
  }

  void noteCost(const Candidate& c, double cost) {
    auto& e = result_.structure.extrema;
    const auto note = [&](FairExtremum& x) {
      x.removalCost = x.costKnown ? std::min(x.removalCost, cost) : cost;
      x.costKnown = true;
    };
    note(e[c.index]);
    if (c.kind == Candidate::Kind::Pair) note(e[(c.index + 1) % e.size()]);
  }

  std::optional<StructureFit> solveWithout(const Candidate& c, FairStructure& rest) const {
    const auto& e = result_.structure.extrema;
    const double from = e[c.index].u;
    double to = c.kind == Candidate::Kind::Pair ? e[(c.index + 1) % e.size()].u : from;
    if (to < from) to += frame_.base.knots().length;
    return fitStructure(frame_, posterior_, rest, result_.c, from, to, kAbortFactor * keepCost_);
  }

  void tryRemoval(const Candidate& c) {
    FairStructure rest = without(result_.structure, c);
    const auto fit = solveWithout(c, rest);
    const double cost = fit ? std::max(0.0, fit->rise) : kAbortFactor * keepCost_;
    if (!fit || fit->aborted || cost >= keepCost_) {
      tested_.insert(key(c));
      noteCost(c, cost);
      return;
    }
    const auto& e = result_.structure.extrema;
    for (std::size_t i = 0; i < (c.kind == Candidate::Kind::Pair ? 2U : 1U); ++i) {
      FairExtremum gone = e[(c.index + i) % e.size()];
      gone.removalCost = cost;
      result_.dropped.push_back(gone);
    }
    result_.limited = result_.limited || !fit->converged;
    result_.structure = std::move(rest);
    result_.c = fit->c;
  }

  /// Costs of the extrema that were too clear to be tested. False when cancelled.
  bool priceTheRest() {
    for (const Candidate& c : candidates(result_.c)) {
      if (context_.isCancelled()) return false;
      if (tested_.count(key(c)) > 0) continue;
      FairStructure rest = without(result_.structure, c);
      const auto fit = solveWithout(c, rest);
      noteCost(c, fit ? std::max(0.0, fit->rise) : kAbortFactor * keepCost_);
    }
    return true;
  }

  const FairFrame& frame_;
  const FairPosterior& posterior_;
  double keepCost_;
  const RunContext& context_;
  bool closed_ = false;
  StructureResult result_;
  std::set<std::pair<int, int>> tested_;
};

}  // namespace

std::optional<StructureResult> findStructure(const FairFrame& frame, const FairPosterior& posterior, double keepCost,
                                             const RunContext& context) {
  return Search(frame, posterior, keepCost, context).run();
}

}  // namespace batten
