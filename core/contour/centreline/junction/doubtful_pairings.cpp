// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/doubtful_pairings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/contour/centreline/junction/end_rows.h"

namespace batten {
namespace {

constexpr int kMostRankedEnds = 7;        // of a junction whose pairings are all looked at: 232
constexpr std::size_t kMostPairings = 5;  // shown beside the rule's own

// [deg] By which the root of the cost of the next best pairing is higher. 10 deg show 12 of 52 wrong places and 16 of
// 590 right ones, 15 deg 19 and 19, 20 deg 25 and 23 (bench_crossings).
constexpr double kDoubtfulDeg = 15.0;

struct Pairing {
  EndPairs pairs;
  double cost = 0.0;  // [deg^2]
};

// All pairings of the ends of a junction, with their costs.
class PairingSearch {
 public:
  PairingSearch(std::span<const MeetingEnd> ends, const PairingScale& scale)
      : used_(ends.size()), openCost_(scale.maxBendDeg * scale.maxBendDeg) {
    const auto rows = scale.areInRows ? std::optional<EndRows>(ends) : std::nullopt;
    for (int a = 0; a < std::ssize(ends); ++a) {
      std::vector<double>& row = cost_.emplace_back();
      for (int b = 0; b < std::ssize(ends); ++b) {
        const double deg = pairCostDeg(ends[a], ends[b], scale, rows ? rows->freePx(a, b) : 0.0);
        row.push_back(deg * deg);
      }
    }
  }

  std::vector<Pairing> find() {
    tryFrom(0);
    return std::move(pairings_);
  }

  double costOf(const EndPairs& pairs) const {
    const std::size_t open = used_.size() / 2 - pairs.size();
    double sum = openCost_ * static_cast<double>(open);
    for (const auto& [a, b] : pairs) sum += cost_[a][b];
    return sum;
  }

 private:
  void tryFrom(int a) {
    const int n = static_cast<int>(used_.size());
    while (a < n && used_[a]) ++a;
    if (a == n) {
      pairings_.push_back({now_, costOf(now_)});
      return;
    }
    for (int b = a + 1; b < n; ++b) {
      if (used_[b]) continue;
      used_[b] = true;
      now_.emplace_back(a, b);
      tryFrom(a + 1);
      now_.pop_back();
      used_[b] = false;
    }
    tryFrom(a + 1);
  }

  std::vector<std::vector<double>> cost_;  // [deg^2]
  std::vector<bool> used_;
  double openCost_;  // [deg^2] of two ends that are not led on: what leads on costs less
  EndPairs now_;
  std::vector<Pairing> pairings_;
};

}  // namespace

JunctionPairings findPairings(std::span<const MeetingEnd> ends, const EndPairs& own, const PairingScale& scale) {
  JunctionPairings found;
  found.pairings.push_back(own);
  if (std::ssize(ends) <= kMostRankedEnds) {
    PairingSearch search(ends, scale);
    std::vector<Pairing> pairings = search.find();
    std::stable_sort(pairings.begin(), pairings.end(),
                     [](const Pairing& a, const Pairing& b) { return a.cost < b.cost; });
    std::erase_if(pairings, [&](const Pairing& pairing) { return pairing.pairs == own; });
    found.cost = search.costOf(own);
    // Whether a stroke goes on at all says the limit of the bend; doubt is about its partner.
    const auto next =
        std::ranges::find(pairings, own.size(), [](const Pairing& pairing) { return pairing.pairs.size(); });
    found.nextCost = next == pairings.end() ? std::numeric_limits<double>::infinity() : next->cost;
    found.isDoubtful = !own.empty() && std::sqrt(found.nextCost) - std::sqrt(found.cost) < kDoubtfulDeg;
    for (Pairing& pairing : pairings) {
      if (found.pairings.size() <= kMostPairings && !pairing.pairs.empty() && pairing.pairs.size() >= own.size())
        found.pairings.push_back(std::move(pairing.pairs));
    }
  }
  if (!own.empty()) found.pairings.emplace_back();
  return found;
}

}  // namespace batten
