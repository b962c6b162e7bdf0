// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/side_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/base/angle.h"
#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/contour/intent/merge_shares.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr double kAlongStep = 0.75;               // a crossing lies within this of the normal
constexpr double kSideCos = 0.86602540378443865;  // 30 degrees
constexpr double kLeastSeen = 0.34;               // of the crossings
constexpr int kLeastCrossings = 2;                // of both together: one may be chance
constexpr double kBesideEnd = 6.0;                // an end beside another strip is no farther from it
constexpr int kAtEnd = 2;                         // samples: a crossing there is one of the end
constexpr int kLevelEnds = 4;                     // samples: by less, ends are level
constexpr double kCrossingSide = 0.3;             // farther to both sides: they cross
constexpr int kStripsPerBlock = 8;                // worked on together; the result does not depend on it

// Of the features. The weights (intent_weights.h) were learned with these: they change together only.
constexpr double kSideAngleUnitDeg = 10.0;
constexpr double kNoDistance = 0.5;     // [stroke widths] added, for the logarithm of nothing
constexpr double kNoSample = 1.0;       // the same of a count
constexpr double kPenOfBundle = 1.0;    // [stroke widths] by which two bundles are wider than their spreads
constexpr double kBesideBundles = 2.0;  // of that width: bundles farther apart lie clear of each other

struct StripPlace {
  int strip, sample;
};

class PairFinder {
 public:
  PairFinder(const std::vector<Strip>& strips, double reach) : strips_(strips), reach_(reach), grid_(reach) {
    for (int s = 0; s < std::ssize(strips); ++s)
      for (int k = 0; k < strips[s].count(); ++k) grid_.add(strips[s].samples[k].at, {s, k});
  }

  // By the other strip: the crossings of one.
  std::map<int, std::vector<StripCrossing>> crossingsOf(int s) const {
    std::map<int, std::vector<StripCrossing>> found;
    const Strip& strip = strips_[s];
    std::map<int, StripCrossing> here;
    for (int k = 0; k < strip.count(); ++k) {
      here.clear();
      collect(s, k, here);
      std::optional<int> first[2];
      for (const auto& [other, c] : here) {
        auto& nearest = first[c.across < 0.0 ? 1 : 0];
        if (!nearest || std::abs(c.across) < std::abs(here.at(*nearest).across)) nearest = other;
      }
      for (auto& [other, c] : here) {
        c.isSeen = first[0] == other || first[1] == other;
        found[other].push_back(c);
      }
    }
    return found;
  }

 private:
  void collect(int s, int k, std::map<int, StripCrossing>& here) const {
    const StripSample& own = strips_[s].samples[k];
    grid_.around(own.at, [&](const StripPlace& p) {
      if (p.strip == s) return;
      const StripSample& beside = strips_[p.strip].samples[p.sample];
      const Vec2 offset = beside.at - own.at;
      if (std::abs(offset.dot(own.tangent)) > kAlongStep) return;
      const double across = leftNormal(own.tangent).dot(offset);
      if (std::abs(across) > reach_) return;
      const double c = beside.tangent.dot(own.tangent);
      if (std::abs(c) <= kSideCos) return;
      const auto [place, isNew] = here.try_emplace(p.strip, StripCrossing{k, p.sample, across, false, c > 0.0});
      if (!isNew && std::abs(across) < std::abs(place->second.across))
        place->second = {k, p.sample, across, false, c > 0.0};
    });
  }

  const std::vector<Strip>& strips_;
  double reach_;
  PointGrid<StripPlace> grid_;
};

bool areSeen(const StripPair& pair) {
  const auto isSeen = [](const StripCrossing& c) { return c.isSeen; };
  const auto seen = std::ranges::count_if(pair.fromA, isSeen) + std::ranges::count_if(pair.fromB, isSeen);
  const auto count = static_cast<double>(pair.fromA.size() + pair.fromB.size());
  return static_cast<double>(seen) >= kLeastSeen * count;
}

// @pre from < to.
double middleOf(const std::vector<StripCrossing>& crossings, std::size_t from, std::size_t to) {
  std::vector<double> sizes;
  for (std::size_t i = from; i < to; ++i) sizes.push_back(std::abs(crossings[i].across));
  return upperMedian(sizes);
}

double partingOf(const std::vector<StripCrossing>& c) {
  const std::size_t quarter = std::max<std::size_t>(1, c.size() / 4);
  if (c.size() < 2) return 0.0;
  return std::abs(middleOf(c, 0, quarter) - middleOf(c, c.size() - quarter, c.size()));
}

// The ends of one strip that lie beside the other: which of the two. The other goes on by `inside` samples there.
std::array<bool, 2> endsBeside(const Strip& strip, const Strip& other, const std::vector<StripCrossing>& crossings,
                               int inside) {
  std::array<bool, 2> beside = {false, false};
  if (strip.closed) return beside;
  for (const StripCrossing& c : crossings) {
    if (std::abs(c.across) > kBesideEnd) continue;
    if (!other.closed && std::min(c.other, other.count() - 1 - c.other) < inside) continue;
    if (c.sample <= kAtEnd) beside[0] = true;
    if (c.sample >= strip.count() - 1 - kAtEnd) beside[1] = true;
  }
  return beside;
}

// What is known of two strips only once bundles were formed. `d` is the logarithm of their distance.
std::vector<double> laterFeatures(const SideMeasures& m, const Strip& shorter, const Strip& longer, double d) {
  const double w = shorter.spread + longer.spread + kPenOfBundle, alone = shorter.members.size() == 1 ? 1.0 : 0.0;
  const double within = m.isWithin ? 1.0 : 0.0;
  int freeOfShorter = 0;
  for (const bool isFree : shorter.isFree) freeOfShorter += isFree ? 1 : 0;
  return {d - std::log(w),
          std::max(0.0, m.middle - kBesideBundles * w) / w,
          std::log(w),
          std::log(static_cast<double>(shorter.members.size())),
          std::log(static_cast<double>(longer.members.size())),
          alone,
          std::log(shorter.inkPerLength),
          std::log(longer.inkPerLength),
          within,
          within * d,
          static_cast<double>(freeOfShorter),
          alone * d,
          std::log(longer.spread + kNoDistance) - std::log(shorter.spread + kNoDistance)};
}

}  // namespace

std::vector<StripPair> findStripPairs(const std::vector<Strip>& strips, double reach, bool all,
                                      const RunContext& context) {
  const PairFinder finder(strips, reach);
  std::vector<std::map<int, std::vector<StripCrossing>>> crossings(strips.size());
  parallelFor(context, static_cast<int>(strips.size()), kStripsPerBlock, [&](int begin, int end) {
    for (int s = begin; s < end && !context.isCancelled(); ++s) crossings[s] = finder.crossingsOf(s);
  });
  if (context.isCancelled()) return {};
  std::map<std::pair<int, int>, StripPair> found;
  for (int s = 0; s < std::ssize(strips); ++s) {
    for (auto& [other, list] : crossings[s]) {
      StripPair& pair = found[std::minmax(s, other)];
      (s < other ? pair.fromA : pair.fromB) = std::move(list);
    }
  }
  std::vector<StripPair> pairs;
  for (auto& [names, pair] : found) {
    if (std::ssize(pair.fromA) + std::ssize(pair.fromB) < kLeastCrossings || !(all || areSeen(pair))) continue;
    pair.a = names.first;
    pair.b = names.second;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

SideMeasures measureSide(const StripPair& pair, const PairView& view) {
  const Strip &a = view.strips[pair.a], &b = view.strips[pair.b];
  SideMeasures m;
  std::vector<double> apart, angles;  // not pairs: medians reorder each of them
  bool toLeft = false, toRight = false;
  int seen = 0;
  for (const auto* list : {&pair.fromA, &pair.fromB}) {
    const Strip &own = list == &pair.fromA ? a : b, &other = list == &pair.fromA ? b : a;
    bool left = false, right = false;
    for (const StripCrossing& c : *list) {
      apart.push_back(std::abs(c.across));
      angles.push_back(
          std::acos(std::min(1.0, std::abs(own.samples[c.sample].tangent.dot(other.samples[c.other].tangent)))));
      left = left || c.across > kCrossingSide;
      right = right || c.across < -kCrossingSide;
      seen += c.isSeen ? 1 : 0;
    }
    if (left && right) toLeft = toRight = true;
  }
  const auto& longer = pair.fromA.size() >= pair.fromB.size() ? pair.fromA : pair.fromB;
  m.isCrossing = toLeft && toRight;
  m.shareSeen = static_cast<double>(seen) / static_cast<double>(apart.size());
  m.middle = upperMedian(apart);
  m.most = lowerQuantile(apart, kMostQuantile);
  m.least = *std::ranges::min_element(apart);
  m.overlap = static_cast<double>(longer.size());
  m.angleDeg = kDegPerRad * upperMedian(angles);
  m.parting = partingOf(longer);
  m.shareA = static_cast<double>(pair.fromA.size()) / a.count();
  m.shareB = static_cast<double>(pair.fromB.size()) / b.count();
  const std::array<bool, 2> ofA = endsBeside(a, b, pair.fromA, 0), ofB = endsBeside(b, a, pair.fromB, 0);
  const std::array<bool, 2> insideB = endsBeside(a, b, pair.fromA, kLevelEnds),
                            insideA = endsBeside(b, a, pair.fromB, kLevelEnds);
  for (const int side : {0, 1}) {
    m.freeEndsBeside += (ofA[side] && a.isFree[side] ? 1 : 0) + (ofB[side] && b.isFree[side] ? 1 : 0);
    m.freeEndsInside += (insideB[side] && a.isFree[side] ? 1 : 0) + (insideA[side] && b.isFree[side] ? 1 : 0);
    m.endsBeside += (ofA[side] ? 1 : 0) + (ofB[side] ? 1 : 0);
  }
  const std::array<bool, 2>& ofShorter = a.count() <= b.count() ? ofA : ofB;
  m.isWithin = ofShorter[0] && ofShorter[1];
  return m;
}

std::vector<double> sideFeatures(const SideMeasures& m, const StripPair& pair, const PairView& view, bool sameLine) {
  constexpr double kTouching = 1.5, kSmallAngleDeg = 12.0;  // [stroke widths]; learned with, as those above
  constexpr int kMostEndsBeside = 2;                        // a cap
  const Strip &a = view.strips[pair.a], &b = view.strips[pair.b];
  const Strip &shorter = a.count() <= b.count() ? a : b, &longer = a.count() <= b.count() ? b : a;
  const double shortest = shorter.count(), longest = longer.count(), g = view.scale;
  const double d = std::log(m.middle + kNoDistance), overlap = std::log(m.overlap + kNoSample);
  const double share = std::min(1.0, m.overlap / shortest), parting = std::log(m.parting + kNoDistance);
  const double ends = std::min(kMostEndsBeside, view.isLater ? m.endsBeside : m.freeEndsBeside);
  const double scale = std::log(g + kNoDistance);
  std::vector<double> f = {d,
                           std::log(m.most + kNoDistance),
                           std::log(m.least + kNoDistance),
                           overlap,
                           d - overlap,
                           share,
                           share * d,
                           m.angleDeg / kSideAngleUnitDeg,
                           share * m.angleDeg / kSideAngleUnitDeg,
                           parting,
                           parting - overlap,
                           ends,
                           ends * d,
                           m.isCrossing ? 1.0 : 0.0,
                           m.shareSeen,
                           d - scale,
                           std::max(0.0, d - scale),
                           std::log(g),
                           m.middle < kTouching ? 1.0 : 0.0,
                           m.most < kTouching ? 1.0 : 0.0,
                           std::log(longest),
                           std::log(shortest),
                           std::max(m.shareA, m.shareB),
                           sameLine && !view.isLater ? 1.0 : 0.0,
                           std::max(0.0, m.most / g - 1.0),
                           std::max(0.0, m.angleDeg - kSmallAngleDeg) / kSideAngleUnitDeg,
                           d * d};
  const std::vector<double> merged = mergeFeatures(a.merged, b.merged, d);
  f.insert(f.end(), merged.begin(), merged.end());
  if (!view.isLater) return f;
  const std::vector<double> later = laterFeatures(m, shorter, longer, d);
  f.insert(f.end(), later.begin(), later.end());
  return f;
}

}  // namespace batten
