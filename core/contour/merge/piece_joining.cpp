// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/piece_joining.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/statistics.h"
#include "core/base/vec2.h"
#include "core/contour/merge/stroke_graph.h"
#include "core/contour/merge/stroke_lines.h"

namespace batten {
namespace {

constexpr double kMaxBendDeg = 40.0;     // a line goes on where it bends no more
constexpr double kEarlyBendDeg = 25.0;   // before the widest bundles are merged
constexpr double kAloneBendDeg = 70.0;   // where nothing else meets
constexpr double kSharedBendDeg = 25.0;  // of lines that share a way
constexpr double kMissDeg = 20.0;        // what a miss by the distance costs
constexpr double kShortDeg = 30.0;       // what going on with an overshoot costs
constexpr double kFacingMiss = 0.6;      // of the way between ends: what they miss each other by
constexpr double kMeet = 0.5;            // distances: ends as near as this meet before anything else
constexpr double kSpur = 2.0;            // distances: shorter things are overshoots
constexpr double kShared = 6.0;          // distances: two lines share no longer way
// A single stroke is an overshoot for as many distances beyond where it leaves the others, for this part of the line
// that it leaves, and at this angle: means are bent there.
constexpr double kOvershoot = 7.0, kOvershootShare = 0.2, kOvershootBendDeg = 60.0;
constexpr float kSingleWeight = 1.5f;  // strokes: between one and two
// Distances and points along a line before it can meet itself.
constexpr double kLoopDistances = 4.0, kLoopPoints = 30.0;
constexpr double kLeastOverlapPx = 4.0;  // ends as near meet, however small the distance
constexpr double kOverlapCos = 0.7;      // 45 degrees: a loop drawn beyond its start runs in its direction
constexpr int kSpurRounds = 3;           // a spur may show only once another has gone

class PieceJoiner {
 public:
  PieceJoiner(RemainingLines pieces, double distancePx, double widestPx)
      : distance_(std::max(1.0, distancePx)),
        widest_(std::max(distance_, widestPx)),
        maxBendDeg_(distance_ < widest_ ? kEarlyBendDeg : kMaxBendDeg),
        graph_(graphOf(std::move(pieces), distance_)) {}

  std::vector<MeanLine> lines(const RunContext& context) {
    dropLoops();
    meetFreeEnds();
    for (int round = 0; round < kSpurRounds; ++round) {
      if (context.isCancelled()) return {};
      dropSpurs();
      spliceAll();
    }
    contractShared();
    dropSpurs();
    spliceAll();
    if (context.isCancelled()) return {};
    for (int n = 0; n < std::ssize(graph_.nodes); ++n) pairAt(n);
    dropLeftOvers();
    pairFacing();
    std::vector<MeanLine> found = follow();
    for (MeanLine& line : found) closeOverlap(line);
    std::erase_if(found, [](const MeanLine& l) { return l.points.size() < 3; });
    return found;
  }

 private:
  int edgeCount() const { return static_cast<int>(graph_.edges.size()); }
  EndTangent look(int end) const { return endTangent(graph_.edges[end / 2].line, end % 2, distance_); }

  // [deg] Of going from one end of an edge to another; nothing where a line does not go on so.
  std::optional<double> cost(int a, int b, double maxBendDeg) const {
    const EndTangent p = look(a), q = look(b);
    const double bend = turnDeg(-p.into, q.into);
    if (bend > maxBendDeg) return std::nullopt;
    const Vec2 d = q.at - p.at;
    const double miss = 0.5 * (std::abs(cross(p.into, d)) + std::abs(cross(q.into, d)));
    return bend + kMissDeg * miss / distance_;
  }

  bool isFree(int end) const { return !graph_.edges[end / 2].node[end % 2]; }
  bool isSpur(int end) const { return isFree(end ^ 1) && graph_.edges[end / 2].length < kSpur * distance_; }

  // A way from a node to itself that is no longer than a spur is nothing.
  void dropLoops() {
    for (int i = 0; i < edgeCount(); ++i) {
      const GraphEdge& l = graph_.edges[i];
      if (l.alive && l.node[0] && l.node[0] == l.node[1] && l.length < 2.0 * kSpur * distance_) graph_.remove(i);
    }
  }

  // Overshoots go where others go on without them, the shortest first.
  void dropSpurs() {
    std::vector<int> order;
    for (int i = 0; i < edgeCount(); ++i)
      if (graph_.edges[i].alive && isFree(2 * i) != isFree(2 * i + 1)) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return graph_.edges[a].length < graph_.edges[b].length; });
    for (const int edge : order) {
      const int end = isFree(2 * edge) ? 2 * edge + 1 : 2 * edge;
      if (!isSpur(end)) continue;
      const std::vector<int>& ends = graph_.nodes[*graph_.edges[edge].node[end % 2]];
      bool others = false;
      for (const int a : ends)
        for (const int b : ends)
          others = others || (a < b && a / 2 != edge && b / 2 != edge && cost(a, b, maxBendDeg_));
      if (others) graph_.remove(edge);
    }
  }

  void spliceAll() {
    for (int n = 0; n < std::ssize(graph_.nodes); ++n) splice(n);
  }

  static void reverse(GraphEdge& edge) {
    reverseLine(edge.line);
    std::swap(edge.node[0], edge.node[1]);
  }

  // Two edges that meet alone and go on as one become one.
  void splice(int node) {
    std::vector<int>& ends = graph_.nodes[node];
    if (ends.size() != 2 || ends[0] / 2 == ends[1] / 2) return;
    const int a = ends[0], b = ends[1];
    if (!cost(a, b, distance_ < widest_ ? kEarlyBendDeg : kAloneBendDeg)) return;
    ends.clear();
    GraphEdge first = graph_.edges[a / 2], second = graph_.edges[b / 2];
    if (a % 2 == 0) reverse(first);
    if (b % 2 == 1) reverse(second);
    graph_.remove(a / 2);
    graph_.remove(b / 2);
    appendLine(first.line, second.line, kSpur * distance_);
    graph_.add(std::move(first.line), first.node[0], second.node[1]);
  }

  // Two lines that cross at a small angle run on one line for a while: the way between is taken out, and they go on as
  // they came.
  void contractShared() {
    for (int i = 0; i < edgeCount(); ++i) {
      const GraphEdge& l = graph_.edges[i];
      if (!l.alive || !l.node[0] || !l.node[1] || l.node[0] == l.node[1] || l.length > kShared * distance_) continue;
      std::vector<int> one = graph_.nodes[*l.node[0]], two = graph_.nodes[*l.node[1]];
      std::erase(one, 2 * i);
      std::erase(two, 2 * i + 1);
      if (one.size() != 2 || two.size() != 2) continue;
      const auto together = [&](int a, int b) {
        const auto c = a / 2 == b / 2 ? std::nullopt : cost(a, b, kSharedBendDeg);
        return c.value_or(std::numeric_limits<double>::infinity());
      };
      const double straight = together(one[0], two[0]) + together(one[1], two[1]);
      const double across = together(one[0], two[1]) + together(one[1], two[0]);
      if (!(std::min(straight, across) < 2.0 * kSharedBendDeg)) continue;
      const int from = *l.node[0], to = *l.node[1];
      graph_.remove(i);
      for (const int end : graph_.nodes[to]) {
        graph_.edges[end / 2].node[end % 2] = from;
        graph_.nodes[from].push_back(end);
      }
      graph_.nodes[to].clear();
    }
  }

  // The shorter what ends free beside longer things, the more it looks like an overshoot.
  double overshootCost(int end, double longest) const {
    if (!isFree(end ^ 1)) return 0.0;
    const double most = std::max(kOvershoot * widest_, kOvershootShare * longest);
    return kShortDeg * std::max(0.0, 1.0 - graph_.edges[end / 2].length / most);
  }

  void pairAt(int node) {
    const std::vector<int>& ends = graph_.nodes[node];
    struct Option {
      double cost;
      int a, b;
    };
    std::vector<Option> options;
    double longest = 0.0;
    for (const int end : ends) longest = std::max(longest, graph_.edges[end / 2].length);
    for (int i = 0; i < std::ssize(ends); ++i)
      for (int j = i + 1; j < std::ssize(ends); ++j) {
        const auto c = cost(ends[i], ends[j], maxBendDeg_);
        if (!c) continue;
        options.push_back({*c + (overshootCost(ends[i], longest) + overshootCost(ends[j], longest)), ends[i], ends[j]});
      }
    std::stable_sort(options.begin(), options.end(), [](const Option& x, const Option& y) { return x.cost < y.cost; });
    partner_.resize(2 * graph_.edges.size());
    for (const Option& o : options) {
      if (partner_[o.a] || partner_[o.b]) continue;
      partner_[o.a] = o.b;
      partner_[o.b] = o.a;
    }
  }

  // [px] of the line that goes through an edge.
  double lineLength(int edge) const {
    double sum = graph_.edges[edge].length;
    for (const int side : {0, 1})
      for (auto end = partner_[2 * edge + side]; end && *end / 2 != edge; end = partner_[*end ^ 1])
        sum += graph_.edges[*end / 2].length;
    return sum;
  }

  // The outer half of an edge that ends free at `end` was drawn once.
  bool isSingle(int end) const {
    const std::vector<MeanPoint>& points = graph_.edges[end / 2].line.points;
    const int count = static_cast<int>(points.size()), half = std::max(1, count / 2);
    std::vector<float> outer;
    outer.reserve(half);
    for (int k = 0; k < half; ++k) outer.push_back(points[end % 2 == 0 ? k : count - 1 - k].weight);
    return upperMedian(outer) < kSingleWeight;
  }

  // A single stroke that leaves a longer line smoothly and ends.
  bool isOvershoot(int edge) const {
    const GraphEdge& l = graph_.edges[edge];
    const int end = l.node[0] ? 2 * edge : 2 * edge + 1;
    if (isFree(end) || !isFree(end ^ 1) || partner_[end] || l.length > kOvershoot * distance_) return false;
    for (const int other : graph_.nodes[*l.node[end % 2]])
      if (other / 2 != edge && partner_[other] && cost(end, other, kOvershootBendDeg) &&
          l.length <= kOvershootShare * lineLength(other / 2))
        return isSingle(end ^ 1);
    return false;
  }

  // What nothing goes on with: overshoots and ways between two lines that nearly touch.
  void dropLeftOvers() {
    partner_.resize(2 * graph_.edges.size());
    for (int i = 0; i < edgeCount(); ++i) {
      const GraphEdge& l = graph_.edges[i];
      if (!l.alive || (!l.node[0] && !l.node[1])) continue;
      const bool alone = !partner_[2 * i] && !partner_[2 * i + 1];
      if ((alone && l.length < kSpur * distance_) || isOvershoot(i)) graph_.edges[i].alive = false;
    }
  }

  std::vector<MeanLine> follow() {
    std::vector<MeanLine> found;
    std::vector<bool> used(graph_.edges.size(), false);
    // First the lines that begin somewhere, then the closed ones.
    for (int pass = 0; pass < 2; ++pass)
      for (int edge = 0; edge < edgeCount(); ++edge)
        for (int side = 0; side < 2; ++side)
          if (graph_.edges[edge].alive && !used[edge] && (pass == 1 || !partner_[2 * edge + side]))
            found.push_back(followFrom(2 * edge + side, used));
    return found;
  }

  MeanLine followFrom(int start, std::vector<bool>& used) const {
    MeanLine line;
    for (int end = start;;) {
      used[end / 2] = true;
      MeanLine more = graph_.edges[end / 2].line;
      if (end % 2 == 1) reverseLine(more);
      if (line.points.empty()) {
        line = std::move(more);
      } else {
        appendLine(line, more, kSpur * distance_);
      }
      const auto next = partner_[end ^ 1];
      if (!next) return line;
      end = *next;
      if (used[end / 2]) {
        closeLine(line, kSpur * distance_);
        return line;
      }
    }
  }

  // A loop drawn beyond its start: what runs along the start goes, and the loop is closed.
  void closeOverlap(MeanLine& line) const {
    const int n = line.count();
    const int apart = static_cast<int>(kLoopDistances * distance_ + kLoopPoints);
    if (line.closed || n < 2 * apart) return;
    const MeanPoint& start = line.points.front();
    std::optional<int> best;
    double nearest = std::max(kLeastOverlapPx, kMeet * distance_);
    for (int i = n - 1; i >= std::max(apart, n / 2); --i) {
      const double d = (line.points[i].at - start.at).norm();
      if (d >= nearest || line.points[i].tangent.dot(start.tangent) < kOverlapCos) continue;
      nearest = d;
      best = i;
    }
    if (!best) return;
    line = partOf(line, 0, *best);
    closeLine(line, kSpur * distance_);
  }

  std::vector<std::pair<int, int>> facing(const std::vector<int>& ends, double mostPx) const;

  // Where a line only begins and another ends, they are one.
  void meetFreeEnds() {
    std::vector<int> ends;
    for (int e = 0; e < 2 * edgeCount(); ++e)
      if (graph_.edges[e / 2].alive && !graph_.edges[e / 2].line.closed && isFree(e)) ends.push_back(e);
    for (const auto& [a, b] : facing(ends, kMeet * distance_)) {
      graph_.edges[a / 2].node[a % 2] = graph_.edges[b / 2].node[b % 2] = static_cast<int>(graph_.nodes.size());
      graph_.nodes.push_back({a, b});
    }
  }

  void pairFacing() {
    std::vector<int> ends;
    for (int e = 0; e < 2 * edgeCount(); ++e)
      if (graph_.edges[e / 2].alive && !graph_.edges[e / 2].line.closed && !partner_[e]) ends.push_back(e);
    for (const auto& [a, b] : facing(ends, distance_)) {
      partner_[a] = b;
      partner_[b] = a;
    }
  }

  double distance_, widest_, maxBendDeg_;
  StrokeGraph graph_;
  std::vector<std::optional<int>> partner_;  // by end: the end that a line goes on at
};

// Ends that look at each other over no more than this way, each in one pair: the nearest first.
std::vector<std::pair<int, int>> PieceJoiner::facing(const std::vector<int>& ends, double mostPx) const {
  struct End {
    int end;
    Vec2 tip;
    EndTangent look;
  };
  std::vector<End> all;
  for (const int e : ends) {
    const MeanLine& l = graph_.edges[e / 2].line;
    all.push_back({e, (e % 2 == 0 ? l.points.front() : l.points.back()).at, look(e)});
  }
  std::stable_sort(all.begin(), all.end(), [](const End& a, const End& b) { return a.tip.x() < b.tip.x(); });
  struct Pair {
    double cost;
    int a, b;
  };
  std::vector<Pair> pairs;
  for (int i = 0; i < std::ssize(all); ++i)
    for (int k = i + 1; k < std::ssize(all) && all[k].tip.x() - all[i].tip.x() <= mostPx; ++k) {
      const End &a = all[i], &b = all[k];
      if ((b.tip - a.tip).norm() > mostPx || turnDeg(-a.look.into, b.look.into) > maxBendDeg_) continue;
      if (a.end / 2 == b.end / 2 && graph_.edges[a.end / 2].length < kLoopDistances * distance_ + kLoopPoints) continue;
      const Vec2 gap = b.look.at - a.look.at;
      const double miss = 0.5 * (std::abs(cross(a.look.into, gap)) + std::abs(cross(b.look.into, gap)));
      if (miss <= kFacingMiss * mostPx) pairs.push_back({gap.norm() + miss, a.end, b.end});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
  std::vector<std::pair<int, int>> chosen;
  std::vector<bool> used(2 * graph_.edges.size(), false);
  for (const Pair& p : pairs) {
    if (used[p.a] || used[p.b]) continue;
    used[p.a] = used[p.b] = true;
    chosen.emplace_back(p.a, p.b);
  }
  return chosen;
}

}  // namespace

std::vector<MeanLine> joinPieces(RemainingLines pieces, double distancePx, double widestPx, const RunContext& context) {
  return PieceJoiner(std::move(pieces), distancePx, widestPx).lines(context);
}

}  // namespace batten
