// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/removal_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/curve/turning_points.h"

namespace batten {
namespace {

constexpr std::size_t kKeptWhereClosed = 4;  // the four-vertex theorem

/// The extrema of the sampled curvature; ends are none.
std::vector<RankedExtremum> extremaOf(const LightReference& reference, double prominence) {
  std::vector<LightSample> samples = reference.samples();
  const auto lower = [](const LightSample& a, const LightSample& b) { return a.kappa < b.kappa; };
  if (reference.isClosed()) {
    std::rotate(samples.begin(), std::max_element(samples.begin(), samples.end(), lower), samples.end());
    samples.push_back(samples.front());
  }
  std::vector<double> kappas;
  for (const LightSample& sample : samples) kappas.push_back(sample.kappa);
  std::vector<RankedExtremum> found;
  const TurningStart start = reference.isClosed() ? TurningStart::OnMaximum : TurningStart::AtEnd;
  for (const TurningPoint& turning : turningPoints(kappas, prominence, start)) {
    const LightSample& sample = samples[turning.index];
    found.push_back({sample.s, sample.kappa, turning.maximum, sample.point, std::nullopt});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.s < b.s; });
  return found;
}

double flattened(double riseOfKappa, double length) {
  return std::abs(riseOfKappa) * length * length / (2.0 * std::numbers::pi * std::numbers::pi);
}

/// The extrema that are still there, and what it would cost to take the next ones.
class Removal {
 public:
  Removal(const LightReference& reference, std::vector<RankedExtremum>& all) : reference_(reference), all_(all) {
    for (std::size_t i = 0; i < all.size(); ++i) left_.push_back(i);
  }

  /// Takes the cheapest pair or end; false when none may go.
  bool takeCheapest() {
    const bool closed = reference_.isClosed();
    if (left_.empty() || (closed && left_.size() <= kKeptWhereClosed)) return false;
    double best = std::numeric_limits<double>::infinity();
    std::size_t at = 0, count = 0;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < left_.size(); ++i) {
      const double cost = pairCost(i, (i + 1) % left_.size());
      if (cost < best) {
        best = cost;
        at = i;
        count = 2;
      }
    }
    if (!closed) {
      for (const bool last : {false, true}) {
        const double cost = endCost(last);
        if (cost >= best) continue;
        best = cost;
        at = last ? left_.size() - 1 : 0;
        count = 1;
      }
    }
    dearest_ = std::max(dearest_, best);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t which = at < left_.size() ? at : 0;  // the second of a pair across the seam is the first
      all_[left_[which]].removal = dearest_;
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(which));
    }
    return true;
  }

 private:
  double pairCost(std::size_t i, std::size_t j) const {
    const RankedExtremum &a = all_[left_[i]], &b = all_[left_[j]];
    double length = b.s - a.s;
    if (length < 0.0) length += reference_.length();
    return flattened(b.kappa - a.kappa, length);
  }
  double endCost(bool last) const {
    const RankedExtremum& e = all_[last ? left_.back() : left_.front()];
    const LightSample& end = last ? reference_.samples().back() : reference_.samples().front();
    return flattened(end.kappa - e.kappa, end.s - e.s);
  }

  const LightReference& reference_;
  std::vector<RankedExtremum>& all_;
  std::vector<std::size_t> left_;
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
