// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace batten {
namespace {

constexpr int kMostRankedEnds = 7;    // of a junction whose ways are all looked at: 232
constexpr std::size_t kMostWays = 5;  // shown beside the rule's own

// [deg] By which the root of the cost of the next best way is higher. Every 5 deg more about double the places that are
// shown although they are right (bench_crossings).
constexpr double kDoubtfulDeg = 10.0;

struct Way {
  EndPairs pairs;
  double cost = 0.0;  // [deg^2]
};

// All ways to pair the ends of a junction, with what they cost.
class AllWays {
 public:
  AllWays(std::span<const MeetingEnd> ends, double nodeRadius, double usualRadius, double maxBendDeg)
      : used_(ends.size()), openCost_(maxBendDeg * maxBendDeg) {
    for (const MeetingEnd& p : ends) {
      std::vector<double>& row = cost_.emplace_back();
      for (const MeetingEnd& q : ends) {
        const double deg = pairCostDeg(p, q, nodeRadius, usualRadius);
        row.push_back(deg * deg);
      }
    }
  }

  std::vector<Way> find() {
    tryFrom(0);
    return std::move(ways_);
  }

  double costOf(const EndPairs& pairs) const {
    double sum = openCost_ * static_cast<double>(used_.size() / 2 - pairs.size());
    for (const auto& [a, b] : pairs) sum += cost_[a][b];
    return sum;
  }

 private:
  void tryFrom(int a) {
    const int n = static_cast<int>(used_.size());
    while (a < n && used_[a]) ++a;
    if (a == n) {
      ways_.push_back({now_, costOf(now_)});
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
  std::vector<Way> ways_;
};

}  // namespace

JunctionWays findWays(std::span<const MeetingEnd> ends, const EndPairs& own, double nodeRadius, double usualRadius,
                      double maxBendDeg) {
  JunctionWays found;
  found.ways.push_back(own);
  if (std::ssize(ends) <= kMostRankedEnds) {
    AllWays all(ends, nodeRadius, usualRadius, maxBendDeg);
    std::vector<Way> ways = all.find();
    std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.cost < b.cost; });
    std::erase_if(ways, [&](const Way& way) { return way.pairs == own; });
    found.cost = all.costOf(own);
    // Whether a stroke goes on at all says the limit of the bend; doubt is about its partner.
    const auto next = std::ranges::find(ways, own.size(), [](const Way& way) { return way.pairs.size(); });
    found.nextCost = next == ways.end() ? std::numeric_limits<double>::infinity() : next->cost;
    found.isDoubtful = !own.empty() && std::sqrt(found.nextCost) - std::sqrt(found.cost) < kDoubtfulDeg;
    for (Way& way : ways) {
      if (found.ways.size() <= kMostWays && !way.pairs.empty() && way.pairs.size() >= own.size())
        found.ways.push_back(std::move(way.pairs));
    }
  }
  if (!own.empty()) found.ways.emplace_back();
  return found;
}

}  // namespace batten
