// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/strip_mean.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/statistics.h"
#include "core/contour/intent/end_edges.h"

namespace batten {
namespace {

// In stroke widths, which are also samples.
constexpr double kMostGap = 14.0;                      // between ends of one curve
constexpr double kMostTurnCos = -0.17364817766693033;  // 100 degrees
constexpr double kTurnCost = 30.0 / std::numbers::pi;  // [per rad] a sixth of a degree
constexpr double kFewCrossings = 20.0;                 // what a pair with few crossings costs
constexpr double kSurelyNear = 4.0;                    // what looks overdrawn as near as this is one
constexpr double kOverdrawnPart = 0.1;  // of its cost: a pair that looks overdrawn comes before the trace
constexpr double kTraceCost = 0.5;      // less than any two ends cost: the trace has joined these
// At one arc length pieces are no farther apart than a multiple of what is usual for the group, but for a few samples.
constexpr double kLeastFarthest = 6.0, kFarthestFactor = 2.0, kFarthestShare = 0.8;
constexpr int kMostFar = 4;                                 // samples
constexpr double kAgreeing = 8.0;                           // relations that disagree by more are the closing of a loop
constexpr double kEndTaper = 6.0, kLeastTaperShare = 0.05;  // at its end a stroke's weight falls to this
constexpr double kTraceWeight = 50.0, kEndWeight = 2.0;     // crossings
constexpr int kRelaxations = 30;                            // rounds: an offset passes on by a piece or more in each
constexpr int kHannReach = 3;                               // samples to either side

// Sample k of the first lies at direction * (sample of the second) + offset.
struct Relation {
  int a = 0, b = 0;  // of the group
  double direction = 1.0, offset = 0.0, cost = 0.0, weight = 0.0;
  std::optional<double> apart = {};  // side by side: kMostQuantile of the distances; absent: end to end
  bool isTrace = false;
  int endA = 0, endB = 0;  // of a trace: which ends meet
};

std::optional<Relation> besideRelation(const StripPair& pair, int a, int b, bool isOne) {
  std::vector<double> along, against, apart;
  const auto add = [&](const StripCrossing& c, double ofA, double ofB) {
    (c.isAlong ? along : against).push_back(c.isAlong ? ofA - ofB : ofA + ofB);
    apart.push_back(std::abs(c.across));
  };
  for (const StripCrossing& c : pair.fromA) add(c, c.sample, c.other);
  for (const StripCrossing& c : pair.fromB) add(c, c.other, c.sample);
  std::vector<double>& offsets = along.size() >= against.size() ? along : against;
  if (offsets.empty()) return std::nullopt;
  Relation r{.a = a, .b = b, .direction = &offsets == &along ? 1.0 : -1.0};
  r.weight = static_cast<double>(offsets.size());
  r.offset = upperMedian(offsets);
  r.cost = upperMedian(apart) + kFewCrossings / (1.0 + r.weight);
  if (isOne && upperMedian(apart) < kSurelyNear) r.cost *= kOverdrawnPart;
  r.apart = lowerQuantile(apart, kMostQuantile);
  return r;
}

std::optional<Relation> endRelation(const Strip& a, const Strip& b, int sideA, int sideB) {
  const Vec2 chord = tipOf(b, sideB) - tipOf(a, sideA);
  const double gap = chord.norm();
  if (gap > kMostGap) return std::nullopt;
  const Vec2 out = directionOut(a, sideA, kDirectionFrom, kDirectionTo);
  const Vec2 in = -directionOut(b, sideB, kDirectionFrom, kDirectionTo);
  const double c = out.dot(in);
  if (c < kMostTurnCos) return std::nullopt;
  Relation r;
  r.endA = sideA;
  r.endB = sideB;
  r.direction = sideA == sideB ? -1.0 : 1.0;
  const double ahead = std::max(0.0, chord.dot(out));
  const double atA = sideA == 1 ? a.count() - 1 + ahead : -ahead;
  r.offset = atA - r.direction * (sideB == 1 ? b.count() - 1 : 0);
  r.cost = gap + kTurnCost * std::acos(std::clamp(c, -1.0, 1.0)) + 1.0;
  r.weight = kEndWeight;
  return r;
}

// [sample] Where a piece lies at a common arc length; absent: not there.
std::optional<double> sampleAt(const Strip& strip, const PlacedPiece& placed, double s) {
  constexpr double kRounding = 1e-6;  // samples
  const double k = placed.direction * (s - placed.offset), last = strip.count() - 1;
  if (k < -kRounding || k > last + kRounding) return std::nullopt;
  return std::clamp(k, 0.0, last);
}

Vec2 pointAtSample(const Strip& strip, double k) {
  const int i = std::min(static_cast<int>(k), std::max(0, strip.count() - 2));
  const int next = std::min(i + 1, strip.count() - 1);
  return strip.samples[i].at + (k - i) * (strip.samples[next].at - strip.samples[i].at);
}

double lowEnd(const Strip& strip, const PlacedPiece& p) {
  return std::min(p.offset, p.offset + p.direction * (strip.count() - 1));
}
double highEnd(const Strip& strip, const PlacedPiece& p) {
  return std::max(p.offset, p.offset + p.direction * (strip.count() - 1));
}

// Pieces of a group on one or several common arc lengths.
class CommonLength {
 public:
  CommonLength(const std::vector<const Strip*>& strips, std::vector<Relation> relations)
      : relations_(std::move(relations)) {
    for (const Strip* strip : strips) pieces_.push_back({.strip = strip, .tree = static_cast<int>(pieces_.size())});
    std::stable_sort(relations_.begin(), relations_.end(),
                     [](const Relation& x, const Relation& y) { return x.cost < y.cost; });
    std::vector<double> apart;
    for (const Relation& r : relations_)
      if (r.apart && *r.apart > 0.0) apart.push_back(*r.apart);
    farthest_ = std::max(kLeastFarthest, apart.empty() ? 0.0 : kFarthestFactor * lowerQuantile(apart, kFarthestShare));
    for (const Relation& r : relations_) join(r);
    relax();
  }
  int tree(int piece) const { return pieces_[piece].tree; }
  const PlacedPiece& placed(int piece) const { return pieces_[piece].placed; }
  bool agrees(const Relation& r) const {
    const PlacedPiece &a = pieces_[r.a].placed, &b = pieces_[r.b].placed;
    return pieces_[r.a].tree == pieces_[r.b].tree && b.direction == a.direction * r.direction &&
           std::abs(a.offset + a.direction * r.offset - b.offset) <= kAgreeing;
  }
  const std::vector<Relation>& relations() const { return relations_; }

 private:
  void join(const Relation& r) {
    const int from = pieces_[r.b].tree, to = pieces_[r.a].tree;
    if (from == to) return;
    const PlacedPiece a = pieces_[r.a].placed, b = pieces_[r.b].placed;
    const double flip = a.direction * r.direction * b.direction;
    const double shift = a.offset + a.direction * r.offset - flip * b.offset;
    if (parts(to, from, flip, shift)) return;
    for (int i = 0; i < std::ssize(pieces_); ++i) {
      if (pieces_[i].tree != from) continue;
      pieces_[i].tree = to;
      pieces_[i].placed.direction *= flip;
      pieces_[i].placed.offset = flip * pieces_[i].placed.offset + shift;
    }
  }
  // Whether two trees, the second moved, lie far apart where they are at the same arc length: a line that forks.
  bool parts(int one, int other, double flip, double shift) const {
    for (int i = 0; i < std::ssize(pieces_); ++i)
      for (int k = 0; k < std::ssize(pieces_); ++k) {
        if (pieces_[i].tree != one || pieces_[k].tree != other) continue;
        PlacedPiece moved = pieces_[k].placed;
        moved.direction *= flip;
        moved.offset = flip * moved.offset + shift;
        if (lowEnd(*pieces_[k].strip, moved) > highEnd(*pieces_[i].strip, pieces_[i].placed) ||
            highEnd(*pieces_[k].strip, moved) < lowEnd(*pieces_[i].strip, pieces_[i].placed))
          continue;
        int far = 0;
        for (int sample = 0; sample < pieces_[k].strip->count(); ++sample) {
          const auto at = sampleAt(*pieces_[i].strip, pieces_[i].placed, moved.direction * sample + moved.offset);
          if (at && (pointAtSample(*pieces_[i].strip, *at) - pieces_[k].strip->samples[sample].at).norm() > farthest_)
            ++far;
        }
        if (far > kMostFar) return true;
      }
    return false;
  }
  // Least squares of the offsets over all relations that agree.
  void relax() {
    std::vector<std::vector<const Relation*>> of(pieces_.size());
    for (const Relation& r : relations_) {
      if (!agrees(r)) continue;
      of[r.a].push_back(&r);
      of[r.b].push_back(&r);
    }
    for (int round = 0; round < kRelaxations; ++round)
      for (int i = 0; i < std::ssize(pieces_); ++i) {
        double sum = 0.0, weights = 0.0;
        for (const Relation* r : of[i]) {
          const PlacedPiece& other = pieces_[r->a == i ? r->b : r->a].placed;
          const double shift = pieces_[r->a].placed.direction * r->offset;
          sum += r->weight * (r->a == i ? other.offset - shift : other.offset + shift);
          weights += r->weight;
        }
        if (weights > 0.0) pieces_[i].placed.offset = sum / weights;
      }
  }

  struct TreePiece {
    const Strip* strip = nullptr;
    PlacedPiece placed = {};
    int tree = 0;
  };
  std::vector<TreePiece> pieces_;
  std::vector<Relation> relations_;
  double farthest_ = 0.0;
};

struct Member {
  const Strip* strip = nullptr;
  PlacedPiece placed;
  bool continues[2] = {false, false};  // in another member
};

double shareAt(const Member& m, double k) {
  double toEnd = kEndTaper;
  if (!m.continues[0]) toEnd = std::min(toEnd, k);
  if (!m.continues[1]) toEnd = std::min(toEnd, m.strip->count() - 1 - k);
  return std::max(kLeastTaperShare, toEnd / kEndTaper);
}

// Places where nothing was drawn lie on the way from one side to the other.
void layOverGaps(PieceMean& mean) {
  std::vector<StripSample>& samples = mean.strip.samples;
  for (int i = 0; i < std::ssize(samples); ++i) {
    if (samples[i].strokes > 0) continue;
    int end = i;
    while (samples[end].strokes == 0) ++end;
    const Vec2 from = samples[i - 1].at, to = samples[end].at;
    for (int k = i; k < end; ++k) samples[k].at = from + (to - from) * (static_cast<double>(k - i + 1) / (end - i + 1));
    i = end;
  }
}

// Smooths what is the mean of several, or laid over a gap; what was drawn once stays.
void smoothMean(PieceMean& mean) {
  std::vector<StripSample>& samples = mean.strip.samples;
  const int n = mean.strip.count();
  const auto hann = [&](auto values) {
    auto smooth = values;
    for (int i = 0; i < n; ++i) {
      const int reach = std::min({kHannReach, i, n - 1 - i});
      auto sum = values[i];
      double weights = 1.0;
      for (int k = 1; k <= reach; ++k) {
        const double w = 0.5 + 0.5 * std::cos(std::numbers::pi * k / (kHannReach + 1));
        sum += w * values[i - k];
        sum += w * values[i + k];
        weights += 2.0 * w;
      }
      smooth[i] = sum / weights;
    }
    return smooth;
  };
  std::vector<double> share;
  share.reserve(samples.size());
  for (const StripSample& sample : samples) share.push_back(sample.strokes == 1 ? 0.0 : 1.0);
  share = hann(share);
  const std::vector<Vec2> smooth = hann(hann(positionsOf(samples)));
  for (int i = 0; i < n; ++i) samples[i].at += std::min(1.0, 2.0 * share[i]) * (smooth[i] - samples[i].at);
}

void measureMean(PieceMean& mean, const std::vector<Member>& members) {
  double squares = 0.0, samples = 0.0;
  for (const Member& m : members)
    for (int k = 0; k < m.strip->count(); ++k) {
      const double s = m.placed.direction * k + m.placed.offset - mean.from;
      const int i = std::clamp(static_cast<int>(std::lround(s)), 0, mean.strip.count() - 1);
      const StripSample& on = mean.strip.samples[i];
      const double across = cross(on.tangent, Vec2(m.strip->samples[k].at - on.at));
      squares += across * across;
      samples += 1.0;
    }
  mean.strip.spread = std::sqrt(squares / samples);
  mean.strip.inkPerLength = samples / mean.strip.count();
}

PieceMean meanOf(const std::vector<Member>& members) {
  PieceMean mean;
  double from = lowEnd(*members[0].strip, members[0].placed), to = highEnd(*members[0].strip, members[0].placed);
  for (const Member& m : members) {
    from = std::min(from, lowEnd(*m.strip, m.placed));
    to = std::max(to, highEnd(*m.strip, m.placed));
    mean.placed.push_back(m.placed);
    mean.strip.members.push_back(m.placed.piece);
  }
  std::sort(mean.strip.members.begin(), mean.strip.members.end());
  mean.from = from;
  const int steps = std::max(1, static_cast<int>(std::lround(to - from)));
  const double step = (to - from) / steps;
  for (int i = 0; i <= steps; ++i) {
    Vec2 sum = Vec2::Zero();
    double shares = 0.0;
    int strokes = 0;
    for (const Member& m : members) {
      const auto k = sampleAt(*m.strip, m.placed, from + i * step);
      if (!k) continue;
      const double share = shareAt(m, *k);
      sum += share * pointAtSample(*m.strip, *k);
      shares += share;
      ++strokes;
    }
    mean.strip.samples.push_back({.at = strokes > 0 ? Vec2(sum / shares) : Vec2::Zero(), .strokes = strokes});
  }
  layOverGaps(mean);
  if (members.size() > 1) smoothMean(mean);
  setTangents(mean.strip);
  measureMean(mean, members);
  return mean;
}

// All that says how the pieces of a group lie to each other; their numbers are places in the group.
std::vector<Relation> relationsOf(const std::vector<int>& group, const StrokePieceSet& set,
                                  const std::vector<StripPair>& pairs, const std::vector<std::vector<int>>& pairsOf,
                                  const std::vector<bool>& areOne) {
  std::map<int, int> local;
  for (int i = 0; i < std::ssize(group); ++i) local[group[i]] = i;
  std::vector<Relation> relations;
  for (const int piece : group)
    for (const int p : pairsOf[piece]) {
      const auto other = local.find(pairs[p].b);
      if (other == local.end()) continue;
      if (auto r = besideRelation(pairs[p], local[piece], other->second, areOne[p])) relations.push_back(*r);
    }
  for (int i = 0; i < std::ssize(group); ++i)
    for (int k = i + 1; k < std::ssize(group); ++k)
      for (int ends = 0; ends < 4; ++ends) {
        const Strip &a = set.pieces[group[i]].strip, &b = set.pieces[group[k]].strip;
        if (a.closed || b.closed) continue;
        auto r = endRelation(a, b, ends / 2, ends % 2);
        if (!r) continue;
        r->a = i;
        r->b = k;
        relations.push_back(*r);
      }
  for (const TraceLink& link : set.links) {
    const auto from = local.find(link.from / 2), to = local.find(link.to / 2);
    if (from == local.end() || to == local.end() || from == to || link.isCorner) continue;
    relations.push_back({.a = from->second,
                         .b = to->second,
                         .offset = static_cast<double>(set.pieces[link.from / 2].strip.count() - 1),
                         .cost = kTraceCost,
                         .weight = kTraceWeight,
                         .isTrace = true,
                         .endA = 1,
                         .endB = 0});
  }
  return relations;
}

}  // namespace

PieceMeans::PieceMeans(const StrokePieceSet& set, const std::vector<StripPair>& pairs, const std::vector<bool>& areOne)
    : set_(set), pairs_(pairs), areOne_(areOne), pairsOf_(set.pieces.size()) {
  for (int p = 0; p < std::ssize(pairs); ++p) pairsOf_[pairs[p].a].push_back(p);
}

std::vector<PieceMean> PieceMeans::of(const std::vector<int>& group) const {
  if (group.size() == 1) {
    PieceMean mean;
    mean.strip = set_.pieces[group[0]].strip;
    mean.placed = {{.piece = group[0]}};
    return {mean};
  }
  std::vector<Relation> relations = relationsOf(group, set_, pairs_, pairsOf_, areOne_);
  std::vector<const Strip*> strips;
  strips.reserve(group.size());
  for (const int piece : group) strips.push_back(&set_.pieces[piece].strip);
  const CommonLength common(strips, std::move(relations));
  std::map<int, std::vector<Member>> trees;
  std::map<int, std::pair<int, int>> at;
  for (int i = 0; i < std::ssize(group); ++i) {
    Member m;
    m.strip = &set_.pieces[group[i]].strip;
    m.placed = common.placed(i);
    m.placed.piece = group[i];
    std::vector<Member>& tree = trees[common.tree(i)];
    at[i] = {common.tree(i), static_cast<int>(tree.size())};
    tree.push_back(m);
  }
  for (const Relation& r : common.relations()) {
    if (!r.isTrace || !common.agrees(r)) continue;
    trees[at[r.a].first][at[r.a].second].continues[r.endA] = true;
    trees[at[r.b].first][at[r.b].second].continues[r.endB] = true;
  }
  std::vector<PieceMean> means;
  means.reserve(trees.size());
  for (const auto& [name, members] : trees) means.push_back(meanOf(members));
  std::stable_sort(means.begin(), means.end(),
                   [](const PieceMean& a, const PieceMean& b) { return a.strip.count() > b.strip.count(); });
  return means;
}

}  // namespace batten
