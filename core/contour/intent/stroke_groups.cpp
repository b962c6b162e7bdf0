// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/stroke_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/contour/intent/contraction.h"
#include "core/contour/intent/end_edges.h"
#include "core/contour/intent/intent_weights.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr double kSideReachLater = 20.0;  // [stroke widths] between bundles that may be one
constexpr double kMostLogOdds = 5.0;      // one confident error is not to win over a bundle
constexpr double kFreeBundleEnd = 2.0;    // and the spread: no other ink within
constexpr double kSurelyOne = 1.0;        // log-odds

std::vector<Strip> stripsOf(const StrokePieceSet& set) {
  std::vector<Strip> strips;
  for (const StrokePiece& p : set.pieces) strips.push_back(p.strip);
  return strips;
}

bool isSameLine(const StrokePieceSet& set, const StripPair& pair) {
  return set.pieces[pair.a].line == set.pieces[pair.b].line;
}

// Weights of all pairs of strips that are one: beside each other, or end to end by the best of their ends.
std::vector<WeightedPair> weigh(int round, const EndView& v, const GroupingProbe& probe, const RunContext& context) {
  const RoundWeights& learned = probe.weights[round];
  const auto tell = [&](bool isSide, int a, int b, const std::vector<double>& features) {
    if (probe.pairs == nullptr) return;
    probe.pairs->push_back({round, isSide, v.view.strips[a].members, v.view.strips[b].members, features});
  };
  const auto limited = [](double z) { return std::clamp(z, -kMostLogOdds, kMostLogOdds); };
  std::vector<WeightedPair> weights;
  std::set<std::pair<int, int>> beside;
  for (const StripPair& pair : v.sides) {
    const bool sameLine = round == 0 && isSameLine(v.pieces, pair);
    const std::vector<double> features = sideFeatures(measureSide(pair, v.view), pair, v.view, sameLine);
    tell(true, pair.a, pair.b, features);
    const double z = logOdds(learned.side, features);
    weights.push_back({pair.a, pair.b, learned.sideFactor * limited(z + learned.sideCaution)});
    beside.insert({pair.a, pair.b});
  }
  std::map<std::pair<int, int>, double> ends;
  for (const EndPair& pair : findEndPairs(v, context)) {
    const std::pair<int, int> strips = std::minmax(pair.a / 2, pair.b / 2);
    const std::vector<double> features = endFeatures(pair, v, beside.contains(strips));
    tell(false, strips.first, strips.second, features);
    const double z = limited(logOdds(learned.end, features) + learned.endCaution);
    const auto [found, isNew] = ends.try_emplace(strips, z);
    if (!isNew) found->second = std::max(found->second, z);
  }
  for (const auto& [strips, z] : ends) weights.push_back({strips.first, strips.second, z});
  return weights;
}

// The mean of a group, for the next round.
Strip bundleOf(const std::vector<int>& members, const StrokePieceSet& set, const PieceMeans& means) {
  Strip strip = means.of(members).front().strip;
  strip.members = members;
  strip.merged.clear();
  double all = 0.0;
  for (const int m : members) all += set.pieces[m].strip.count();
  for (const int m : members)
    for (const auto& [line, share] : set.pieces[m].strip.merged)
      strip.merged[line] += share * set.pieces[m].strip.count() / all;
  return strip;
}

void setFreeBundleEnds(std::vector<Strip>& strips, const StrokePieceSet& set) {
  struct InkPlace {
    int piece;
    Vec2 at;
  };
  double widest = 0.0;
  for (const Strip& s : strips) widest = std::max(widest, s.spread);
  PointGrid<InkPlace> ink(kFreeBundleEnd + widest);
  for (int p = 0; p < std::ssize(set.pieces); ++p)
    for (const StripSample& sample : set.pieces[p].strip.samples) ink.add(sample.at, {p, sample.at});
  for (Strip& s : strips)
    for (const int side : {0, 1}) {
      bool isFree = !s.closed;
      ink.around(tipOf(s, side), [&](const InkPlace& place) {
        if (!isFree || (place.at - tipOf(s, side)).norm() > kFreeBundleEnd + s.spread) return;
        isFree = std::ranges::binary_search(s.members, place.piece);
      });
      s.isFree[side] = isFree;
    }
}

}  // namespace

int overdrawnPlaces(const StrokePieceSet& set, const std::vector<StripPair>& pairs) {
  constexpr double kNearest = 0.8, kFarthest = 8.0;  // [stroke widths] apart: one stroke, two lines
  constexpr double kLongEnough = 5.0;                // samples beside each other
  const std::vector<Strip> strips = stripsOf(set);
  const PairView view{strips};
  return static_cast<int>(std::ranges::count_if(pairs, [&](const StripPair& pair) {
    const SideMeasures m = measureSide(pair, view);
    return m.freeEndsInside > 0 && m.middle > kNearest && m.middle < kFarthest && m.overlap >= kLongEnough;
  }));
}

std::vector<bool> lookOverdrawn(const StrokePieceSet& set, const std::vector<StripPair>& pairs, double scale) {
  const std::vector<Strip> strips = stripsOf(set);
  const PairView view{strips, scale};
  std::vector<bool> one;
  one.reserve(pairs.size());
  for (const StripPair& pair : pairs)
    one.push_back(logOdds(learnedWeights()[0].side,
                          sideFeatures(measureSide(pair, view), pair, view, isSameLine(set, pair))) > kSurelyOne);
  return one;
}

std::vector<std::vector<int>> groupPieces(const StrokePieceSet& set, const PieceMeans& means,
                                          const std::vector<StripPair>& pairs, double scale, const RunContext& context,
                                          const GroupingProbe& probe) {
  std::vector<Strip> strips = stripsOf(set);
  std::vector<StripPair> sides = pairs;
  for (int round = 0; round < kIntentRounds; ++round) {
    const EndView v{{strips, scale, round > 0}, set, sides};
    const std::vector<int> cluster =
        contractGreedily(static_cast<int>(strips.size()), weigh(round, v, probe, context), context);
    if (context.isCancelled()) return {};
    std::vector<std::vector<int>> groups;
    for (int s = 0; s < std::ssize(strips); ++s) {
      if (cluster[s] >= std::ssize(groups)) groups.resize(cluster[s] + 1);
      groups[cluster[s]].insert(groups[cluster[s]].end(), strips[s].members.begin(), strips[s].members.end());
    }
    for (auto& group : groups) std::sort(group.begin(), group.end());
    if (round == kIntentRounds - 1) return groups;
    strips.clear();
    for (const auto& group : groups) {
      if (context.isCancelled()) return {};
      strips.push_back(bundleOf(group, set, means));
    }
    setFreeBundleEnds(strips, set);
    sides = findStripPairs(strips, kSideReachLater, false, context);
  }
  return {};
}

}  // namespace batten
