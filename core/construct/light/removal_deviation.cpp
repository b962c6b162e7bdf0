// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/removal_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "core/curve/extremum_indices.h"

namespace batten {
namespace {

constexpr std::ptrdiff_t kKeptWhereClosed = 4;  // the four-vertex theorem

/// The extrema of the sampled curvature; ends are none.
std::vector<RankedExtremum> extremaOf(const LightReference& reference, double prominence) {
  std::vector<LightSample> samples = reference.samples();
  const auto lower = [](const LightSample& a, const LightSample& b) { return a.kappa < b.kappa; };
  if (reference.isClosed()) {
    std::rotate(samples.begin(), std::max_element(samples.begin(), samples.end(), lower), samples.end());
    samples.push_back(samples.front());
  }
  std::vector<double> kappas;
  kappas.reserve(samples.size());
  for (const LightSample& sample : samples) kappas.push_back(sample.kappa);
  std::vector<RankedExtremum> found;
  const SequenceStart start = reference.isClosed() ? SequenceStart::OnMaximum : SequenceStart::AtEnd;
  for (const ExtremumIndex& extremum : extremumIndices(kappas, prominence, start)) {
    const LightSample& sample = samples[extremum.index];
    found.push_back({sample.s, sample.kappa, extremum.maximum, sample.point, std::nullopt});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.s < b.s; });
  return found;
}

double flattened(double riseOfKappa, double length) {
  return std::abs(riseOfKappa) * length * length / (2.0 * std::numbers::pi * std::numbers::pi);
}

/// The extrema that are still there, and what it would cost to take the next ones. Each removal costs the logarithm of
/// their number: the costs of neighbours are kept in order.
class Removal {
 public:
  Removal(const LightReference& reference, std::vector<RankedExtremum>& all)
      : reference_(reference), all_(all), closed_(reference.isClosed()), count_(std::ssize(all)), left_(count_) {
    for (std::ptrdiff_t i = 0; i < count_; ++i) {
      before_.push_back(i - 1);
      behind_.push_back(i + 1);
      cost_.push_back(0.0);
    }
    if (closed_ && count_ > 0) {
      before_.front() = count_ - 1;
      behind_.back() = 0;
    }
    for (std::ptrdiff_t i = 0; i + (closed_ ? 0 : 1) < count_; ++i) insertPair(i);
  }

  /// Takes the cheapest pair or end, of equally cheap ones a pair, and the first; false when none may go.
  bool takeCheapest() {
    if (left_ == 0 || (closed_ && left_ <= kKeptWhereClosed)) return false;
    double best = std::numeric_limits<double>::infinity();
    std::optional<std::ptrdiff_t> at;
    bool isPair = false;
    if (!pairs_.empty() && pairs_.begin()->first < best) {
      best = pairs_.begin()->first;
      at = pairs_.begin()->second;
      isPair = true;
    }
    if (!closed_) {
      for (const bool last : {false, true}) {
        const double cost = endCost(last);
        if (cost >= best) continue;
        best = cost;
        at = last ? last_ : first_;
        isPair = false;
      }
    }
    if (!at) return false;
    dearest_ = std::max(dearest_, best);
    const std::ptrdiff_t behind = behind_[*at];
    take(*at);
    if (isPair) take(behind);
    return true;
  }

 private:
  double pairCost(std::ptrdiff_t i, std::ptrdiff_t j) const {
    const RankedExtremum &a = all_[i], &b = all_[j];
    double length = b.s - a.s;
    if (length < 0.0) length += reference_.length();
    return flattened(b.kappa - a.kappa, length);
  }
  double endCost(bool last) const {
    const RankedExtremum& e = all_[last ? last_ : first_];
    const LightSample& end = last ? reference_.samples().back() : reference_.samples().front();
    return flattened(end.kappa - e.kappa, end.s - e.s);
  }
  void insertPair(std::ptrdiff_t i) {
    cost_[i] = pairCost(i, behind_[i]);
    pairs_.emplace(cost_[i], i);
  }
  void take(std::ptrdiff_t i) {
    all_[i].removal = dearest_;
    --left_;
    const std::ptrdiff_t before = before_[i], behind = behind_[i];
    const bool hasBefore = closed_ || i != first_, hasBehind = closed_ || i != last_;
    if (hasBefore) pairs_.erase({cost_[before], before});
    if (hasBehind) pairs_.erase({cost_[i], i});
    if (i == first_) first_ = behind;
    if (i == last_) last_ = before;
    if (hasBefore) behind_[before] = behind;
    if (hasBehind) before_[behind] = before;
    if (hasBefore && hasBehind && left_ > 0) insertPair(before);
  }

  const LightReference& reference_;
  std::vector<RankedExtremum>& all_;
  bool closed_;
  std::ptrdiff_t count_, left_, first_ = 0, last_ = count_ - 1;
  std::vector<std::ptrdiff_t> before_, behind_;  ///< Neighbours of those that are left.
  std::vector<double> cost_;                     ///< Of each with the one behind it.
  std::set<std::pair<double, std::ptrdiff_t>> pairs_;
  double dearest_ = 0.0;
};

}  // namespace

std::vector<RankedExtremum> rankedExtrema(const LightReference& reference, double prominence) {
  std::vector<RankedExtremum> all = extremaOf(reference, prominence);
  Removal removal(reference, all);
  while (removal.takeCheapest()) {
  }
  return all;
}

std::vector<RankedExtremum> significantExtrema(const std::vector<RankedExtremum>& all, double least) {
  std::vector<RankedExtremum> kept;
  for (const RankedExtremum& extremum : all) {
    if (!extremum.removal || *extremum.removal >= least) kept.push_back(extremum);
  }
  return kept;
}

int countInflections(const LightReference& reference, double threshold) {
  int count = 0, sign = 0, first = 0;
  for (const LightSample& sample : reference.samples()) {
    if (!(std::abs(sample.kappa) > threshold)) continue;
    const int here = sample.kappa > 0.0 ? 1 : -1;
    if (sign != 0 && here != sign) ++count;
    if (first == 0) first = here;
    sign = here;
  }
  return count + (reference.isClosed() && first != sign ? 1 : 0);
}

}  // namespace batten
