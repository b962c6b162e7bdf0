// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_structure_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/base/statistics.h"
#include "core/construct/fair/fair_structure.h"
#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

constexpr double kPersistence = 1.0;         // standard deviations of kappa below which an extremum is not worth a test
constexpr double kCertain = 8.0;             // standard deviations above which the search stops
constexpr int kClosedLeast = 4;              // four vertex theorem
constexpr double kConstraintReachPx = 24.0;  // beyond the window in which an extremum may lie
constexpr double kAbortFactor = 3.0;         // a program is cut short once its cost has passed this many thresholds

/// The removal of one extremum at an end, or of two neighbours.
struct StructureCandidate {
  enum class Kind { First, Last, Pair } kind = Kind::Pair;
  std::size_t index = 0;  ///< Of the (first) extremum.
  double change = 0.0;    ///< [1/px] difference of curvature that disappears.
};

/// Removes extrema as long as the misfit rises too little to keep them.
class ExtremumRemoval {
 public:
  ExtremumRemoval(const FairFrame& frame, const FairPosterior& posterior, double keepCost,
                  const std::vector<PlacedConstraint>& constraints, const RunContext& context)
      : frame_(frame), posterior_(posterior), keepCost_(keepCost), constraints_(constraints), context_(context) {
    closed_ = frame.base.knots().closed;
    std::vector<double> sigma;
    for (const FrameStation& s : frame.checks) {
      sigma.push_back(std::sqrt(std::max(0.0, BandedCholesky::quadratic(posterior.covariance, s.kappaRow))));
    }
    result_.kappaSigma = upperMedian(sigma);
    isFactored_ = factors_.factor(posterior.a);
  }

  std::optional<StructureResult> run() {
    if (!search()) return std::nullopt;
    if (!constraints_.empty() && !applyConstraints()) return std::nullopt;
    if (!priceTheRest()) return std::nullopt;
    result_.objective = posterior_.objective(result_.c);
    return std::move(result_);
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();  // of a cost or distance: none yet

  /// Drops what is cheap enough and not held. False when cancelled or when the first program cannot be solved.
  bool search() {
    result_.structure = localExtrema(frame_, posterior_.mean);
    result_.dropped.clear();
    result_.c.resize(0);
    tested_.clear();
    if (!simplify()) return false;
    auto fit = fitStructure(frame_, posterior_, result_.structure, posterior_.mean, {}, context_);
    if (!fit) return false;
    result_.c = fit->c;
    result_.limited = !fit->converged;
    while (!result_.structure.extrema.empty()) {
      if (context_.isCancelled()) return false;
      const auto next = cheapest(true);
      if (!next || (!tested_.empty() && next->change > kCertain * result_.kappaSigma)) break;
      tryRemoval(*next);
    }
    return true;
  }

  /// The extremum, kept or dropped, that a constraint is about.
  FairExtremum* nearest(const PlacedConstraint& constraint) {
    FairExtremum* best = nullptr;
    double least = kNever;
    const UniformKnots& knots = frame_.base.knots();
    for (auto* list : {&result_.structure.extrema, &result_.dropped}) {
      for (FairExtremum& e : *list) {
        double distance = std::abs(e.u - constraint.u);
        if (closed_) distance = std::abs(distance - knots.length * std::round(distance / knots.length));
        if (distance > kConstraintReachPx + e.halfWidth || distance >= least) continue;
        least = distance;
        best = &e;
      }
    }
    return best;
  }

  /// Holds what is to be kept, searching once more if that had been dropped, and takes out what is to go.
  bool applyConstraints() {
    std::map<int, PlacedConstraint> wanted;  // by extremum; of two constraints for one the later counts
    for (const PlacedConstraint& constraint : constraints_) {
      if (const FairExtremum* e = nearest(constraint)) {
        wanted[e->id] = constraint;
      } else {
        result_.unmetConstraints.push_back(constraint.id);
      }
    }
    bool again = false;
    for (const auto& [id, constraint] : wanted) {
      if (!constraint.keep) continue;
      held_.insert(id);
      again = again || find(id) == result_.structure.extrema.size();
    }
    if (again && !search()) return false;
    for (const auto& [id, constraint] : wanted) {
      if (context_.isCancelled()) return false;
      if (!constraint.keep && !forceOut(id)) result_.unmetConstraints.push_back(constraint.id);
    }
    for (const auto& [id, constraint] : wanted) {
      bool met = false;
      for (auto* list : {&result_.structure.extrema, &result_.dropped}) {
        for (FairExtremum& e : *list) {
          if (e.id == id) e.constraint = constraint.id, met = true;
        }
      }
      if (!met) result_.unmetConstraints.push_back(constraint.id);
    }
    return true;
  }

  /// Place of an extremum in the structure; the number of extrema when it is not there.
  std::size_t find(int id) const {
    const auto& e = result_.structure.extrema;
    return std::find_if(e.begin(), e.end(), [id](const FairExtremum& x) { return x.id == id; }) - e.begin();
  }

  bool touches(const StructureCandidate& c, int id) const {
    const auto& e = result_.structure.extrema;
    return e[c.index].id == id || (c.kind == StructureCandidate::Kind::Pair && e[(c.index + 1) % e.size()].id == id);
  }

  bool isHeld(const StructureCandidate& c) const {
    return std::any_of(held_.begin(), held_.end(), [&](int id) { return touches(c, id); });
  }

  /// Removes an extremum by the cheapest candidate. False if there is none; true if it is already gone.
  bool forceOut(int id) {
    if (find(id) == result_.structure.extrema.size()) return true;
    std::optional<StructureFit> best;
    std::optional<StructureCandidate> how;
    FairStructure after;
    for (const StructureCandidate& c : candidates(result_.c)) {
      if (!touches(c, id) || isHeld(c)) continue;
      FairStructure rest = without(result_.structure, c);
      auto fit = fitStructure(frame_, posterior_, rest, result_.c, {}, context_);
      if (!fit || fit->aborted || (best && best->rise <= fit->rise)) continue;
      best = std::move(fit);
      how = c;
      after = std::move(rest);
    }
    if (!best) return false;
    drop(*how, std::max(0.0, best->rise), std::move(after), *best);
    return true;
  }

  std::pair<int, int> key(const StructureCandidate& c) const {
    const auto& e = result_.structure.extrema;
    switch (c.kind) {
      case StructureCandidate::Kind::First:
        return {-1, e[c.index].id};
      case StructureCandidate::Kind::Last:
        return {e[c.index].id, -1};
      case StructureCandidate::Kind::Pair:
        break;
    }
    return {e[c.index].id, e[(c.index + 1) % e.size()].id};
  }

  std::vector<StructureCandidate> candidates(const Eigen::VectorXd& c) const {
    std::vector<StructureCandidate> list;
    const auto& e = result_.structure.extrema;
    if (e.empty() || (closed_ && static_cast<int>(e.size()) <= kClosedLeast)) return list;
    for (std::size_t i = 0; i + 1 < e.size() + (closed_ ? 1 : 0); ++i) {
      list.push_back({StructureCandidate::Kind::Pair, i, std::abs(e[i].kappa - e[(i + 1) % e.size()].kappa)});
    }
    if (!closed_) {
      const double atStart = kappaAt(frame_.checks.front(), c), atEnd = kappaAt(frame_.checks.back(), c);
      list.push_back({StructureCandidate::Kind::First, 0, std::abs(e.front().kappa - atStart)});
      list.push_back({StructureCandidate::Kind::Last, e.size() - 1, std::abs(e.back().kappa - atEnd)});
    }
    return list;
  }

  std::optional<StructureCandidate> cheapest(bool untestedOnly) const {
    std::optional<StructureCandidate> best;
    for (const StructureCandidate& c : candidates(result_.c.size() > 0 ? result_.c : posterior_.mean)) {
      if (untestedOnly && tested_.count(key(c)) > 0) continue;
      if (isHeld(c)) continue;
      if (!best || c.change < best->change) best = c;
    }
    return best;
  }

  static FairStructure without(const FairStructure& structure, const StructureCandidate& c) {
    FairStructure rest = structure;
    auto& e = rest.extrema;
    const FairExtremum gone = e[c.index];
    switch (c.kind) {
      case StructureCandidate::Kind::First:
        rest.rising = !gone.maximum;
        e.erase(e.begin());
        break;
      case StructureCandidate::Kind::Last:
        rest.rising = gone.maximum;
        e.pop_back();
        break;
      case StructureCandidate::Kind::Pair:
        rest.rising = gone.maximum;
        e.erase(e.begin() + static_cast<std::ptrdiff_t>(c.index));
        e.erase(e.begin() + static_cast<std::ptrdiff_t>(c.index % e.size()));
        break;
    }
    return rest;
  }

  /// Drops what lies within the noise of the curvature without any program, smallest first. False when cancelled.
  bool simplify() {
    while (!context_.isCancelled()) {
      const auto next = cheapest(false);
      if (!next || next->change >= kPersistence * result_.kappaSigma) return true;
      result_.structure = without(result_.structure, *next);
    }
    return false;
  }

  void noteCost(const StructureCandidate& c, double cost) {
    auto& e = result_.structure.extrema;
    const auto note = [&](FairExtremum& x) {
      x.removalCost = x.costKnown ? std::min(x.removalCost, cost) : cost;
      x.costKnown = true;
    };
    note(e[c.index]);
    if (c.kind == StructureCandidate::Kind::Pair) note(e[(c.index + 1) % e.size()]);
  }

  std::optional<StructureFit> solveWithout(const StructureCandidate& c, FairStructure& rest) const {
    const auto& e = result_.structure.extrema;
    const double from = e[c.index].u;
    double to = c.kind == StructureCandidate::Kind::Pair ? e[(c.index + 1) % e.size()].u : from;
    if (to < from) to += frame_.base.knots().length;
    return fitStructure(frame_, posterior_, rest, result_.c, {StructureStretch{from, to}, kAbortFactor * keepCost_},
                        context_);
  }

  /// A rise of the objective that the removal costs at least, from one inequality that it asks for: where the curvature
  /// falls between the two extrema (or an extremum and the end) it must not fall any more. Costs one solution instead
  /// of a program. 0 when nothing can be said.
  double leastCost(const StructureCandidate& c, const FairStructure& rest) const {
    const UniformKnots& knots = frame_.base.knots();
    const auto& e = result_.structure.extrema;
    const bool pair = c.kind == StructureCandidate::Kind::Pair;
    const FairExtremum &first = e[c.index], &second = pair ? e[(c.index + 1) % e.size()] : first;
    double from = first.u, to = second.u;
    if (c.kind == StructureCandidate::Kind::First) from = 0.0;
    if (c.kind == StructureCandidate::Kind::Last) to = knots.length;
    if (pair && to < from) to += knots.length;
    // The neighbours that stay may move within their windows, and the windows may follow them once.
    FairStructure widened = rest;
    setWindows(widened, knots);
    for (const FairExtremum& other : widened.extrema) {
      for (const double lap : {-knots.length, 0.0, knots.length}) {
        const double low = other.u - 2.0 * other.halfWidth + lap, high = other.u + 2.0 * other.halfWidth + lap;
        if (!knots.closed && lap != 0.0) continue;
        if (high <= from || low >= to) continue;
        if (other.u + lap <= 0.5 * (from + to)) {
          from = std::max(from, high);
        } else {
          to = std::min(to, low);
        }
      }
    }
    if (!isFactored_) return 0.0;
    const auto count = static_cast<int>(frame_.checks.size());
    const double step = knots.length / (closed_ ? count : count - 1);
    const int a = static_cast<int>(std::ceil(from / step)), b = static_cast<int>(std::floor(to / step));
    if (b <= a) return 0.0;
    const FrameStation &low = frame_.checks[a % count], &high = frame_.checks[b % count];
    // Which way it falls now: from a maximum down, from a minimum up.
    const double sign = (c.kind == StructureCandidate::Kind::First ? !first.maximum : first.maximum) ? 1.0 : -1.0;
    const double violation = sign * (kappaAt(low, posterior_.mean) - kappaAt(high, posterior_.mean));
    if (!(violation > 0.0)) return 0.0;
    Eigen::VectorXd row = Eigen::VectorXd::Zero(posterior_.b.size());
    addTo(row, low.kappaRow, 1.0);
    addTo(row, high.kappaRow, -1.0);
    const double variance = row.dot(factors_.solve(row));
    if (!(variance > 0.0)) return 0.0;
    const double above = posterior_.objective(result_.c) - posterior_.objective(posterior_.mean);
    return violation * violation / variance - above;
  }

  void tryRemoval(const StructureCandidate& c) {
    FairStructure rest = without(result_.structure, c);
    if (const double least = leastCost(c, rest); least > kAbortFactor * keepCost_) {
      tested_.insert(key(c));
      noteCost(c, least);
      return;
    }
    const auto fit = solveWithout(c, rest);
    const double cost = fit ? std::max(0.0, fit->rise) : kAbortFactor * keepCost_;
    if (!fit || fit->aborted || cost >= keepCost_) {
      tested_.insert(key(c));
      noteCost(c, cost);
      return;
    }
    drop(c, cost, std::move(rest), *fit);
  }

  void drop(const StructureCandidate& c, double cost, FairStructure rest, const StructureFit& fit) {
    const auto& e = result_.structure.extrema;
    for (std::size_t i = 0; i < (c.kind == StructureCandidate::Kind::Pair ? 2U : 1U); ++i) {
      FairExtremum gone = e[(c.index + i) % e.size()];
      gone.removalCost = cost;
      result_.dropped.push_back(gone);
    }
    result_.limited = result_.limited || !fit.converged;
    result_.structure = std::move(rest);
    result_.c = fit.c;
  }

  /// Costs of the extrema that were too clear to be tested. False when cancelled.
  bool priceTheRest() {
    for (const StructureCandidate& c : candidates(result_.c)) {
      if (context_.isCancelled()) return false;
      if (tested_.count(key(c)) > 0) continue;
      FairStructure rest = without(result_.structure, c);
      if (const double least = leastCost(c, rest); least > kAbortFactor * keepCost_) {
        noteCost(c, least);
        continue;
      }
      const auto fit = solveWithout(c, rest);
      noteCost(c, fit ? std::max(0.0, fit->rise) : kAbortFactor * keepCost_);
    }
    return true;
  }

  const FairFrame& frame_;
  const FairPosterior& posterior_;
  double keepCost_;
  const std::vector<PlacedConstraint>& constraints_;
  const RunContext& context_;
  bool closed_ = false;
  BandedCholesky factors_;  ///< Of the posterior.
  bool isFactored_ = false;
  StructureResult result_;
  std::set<std::pair<int, int>> tested_;
  std::set<int> held_;  ///< Extrema that the user wants to keep.
};

}  // namespace

std::optional<StructureResult> findStructure(const FairFrame& frame, const FairPosterior& posterior, double keepCost,
                                             const std::vector<PlacedConstraint>& constraints,
                                             const RunContext& context) {
  return ExtremumRemoval(frame, posterior, keepCost, constraints, context).run();
}

}  // namespace batten
