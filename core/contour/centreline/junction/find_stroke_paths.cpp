// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/find_stroke_paths.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/base/vec2.h"
#include "core/contour/centreline/junction/doubtful_pairings.h"
#include "core/contour/centreline/junction/end_pairing.h"
#include "core/contour/centreline/junction/end_rows.h"
#include "core/contour/centreline/junction/junction_choices.h"
#include "core/contour/centreline/junction/merged_junctions.h"
#include "core/contour/centreline/skeleton/skeleton_graph.h"
#include "core/contour/centreline/skeleton/skeleton_spurs.h"

namespace batten {
namespace {

constexpr double kLeastLastStepPx = 0.3;  // a shorter last step is left out
constexpr double kBesideDisc = 2.0;   // [half stroke widths] beyond a junction's disc the other stroke is still near
constexpr double kReadWidths = 10.0;  // [stroke widths] a shorter edge between shared ink lies in its discs
// [deg] by which two strokes bend that are led through a hidden link: those that lie side by side in a bundle bend
// less; and one that goes straight on.
constexpr double kLeastBend = 25.0, kMostStraightBend = 10.0;
constexpr double kPlaceWidths = 1.0;  // [stroke widths] beyond the junction: the place that stands for a branch

bool isOfBundles(const EdgeParams& params) { return params.mergeWidths > 0.0 && !params.intent; }

class StrokePathMaker {
 public:
  StrokePathMaker(const SkeletonGraph& graph, const EdgeParams& params, JunctionsOf of)
      : graph_(graph), params_(params), of_(of), ends_(2 * graph.edges().size()), partner_(2 * graph.edges().size()) {}

  StrokePathSet make() {
    StrokePathSet found;
    const std::vector<std::optional<int>> choiceOf = choicesOfNodes(graph_, params_.junctions);
    std::vector<std::optional<int>> junctionOf(graph_.nodes().size());
    for (int i = 0; i < std::ssize(graph_.nodes()); ++i) {
      std::optional<StrokeJunction> junction = pair(graph_.nodes()[i]);
      if (!junction) continue;
      junctionOf[i] = static_cast<int>(found.junctions.size());
      found.junctions.push_back(std::move(*junction));
    }
    for (int edge = 0; edge < std::ssize(graph_.edges()); ++edge) {
      // The grain of a pencil makes such edges of its own.
      if (of_ == JunctionsOf::Pen && isHiddenLink(edge)) pairAcross(edge, junctionOf, found.junctions);
    }
    for (int i = 0; i < std::ssize(graph_.nodes()); ++i) {
      if (choiceOf[i])
        choose(graph_.nodes()[i], *choiceOf[i], junctionOf[i] ? &found.junctions[*junctionOf[i]] : nullptr);
    }
    for (int edge = 0; edge < std::ssize(graph_.edges()); ++edge) {
      if (!isShared(edge)) continue;
      for (const std::optional<int> node : edge_(edge).node) found.junctions[*junctionOf[*node]].isDoubtful = true;
    }
    std::vector<StrokePath>& paths = found.paths;
    std::vector<bool> used(graph_.edges().size(), false);
    for (int pass = 0; pass < 2; ++pass) {
      for (int edge = 0; edge < std::ssize(graph_.edges()); ++edge) {
        if (!graph_.edges()[edge].alive || used[edge]) continue;
        for (int side = 0; side < 2; ++side) {
          // First the stroke paths that begin somewhere, then the closed ones.
          if (used[edge] || (pass == 0 && (edge_(edge).ring || partner_[2 * edge + side]))) continue;
          paths.push_back(follow(2 * edge + side, used));
        }
      }
    }
    return found;
  }

 private:
  const SkeletonEdge& edge_(int i) const { return graph_.edges()[i]; }
  EdgeFromEnd fromEnd(int end) const { return {edge_(end / 2).points, end % 2}; }
  std::vector<EdgeFromEnd> edgesOf(const SkeletonNode& node) const {
    std::vector<EdgeFromEnd> edges;
    for (const int end : node.ends) edges.push_back(fromEnd(end));
    return edges;
  }
  const StrokePathPoint& point(int end, int k) const { return fromEnd(end)[k]; }

  // Nothing where less than three ends meet.
  std::optional<StrokeJunction> pair(const SkeletonNode& node) {
    if (node.ends.size() < 2) return std::nullopt;
    const std::vector<EdgeFromEnd> edges = edgesOf(node);
    const std::vector<MeetingEnd> meeting = measureEnds(edges, node, graph_.medianRadius());
    for (int i = 0; i < std::ssize(meeting); ++i) ends_[node.ends[i]] = meeting[i];
    const PairingScale scale = scaleOf(node, meeting);
    const EndPairs own = ownPairs(node, edges, meeting, scale);
    setPartners(node, own);
    if (node.ends.size() < 3) return std::nullopt;
    StrokeJunction junction;
    junction.positionPx = node.centre;
    junction.radiusPx = node.radius;
    junction.pairs = own;
    for (int i = 0; i < std::ssize(edges); ++i) junction.branchesPx.push_back(placeOn(edges[i], meeting[i].first));
    JunctionPairings found = findPairings(meeting, own, scale);
    junction.pairings = std::move(found.pairings);
    const LedThrough* led = node.leading();
    junction.isDoubtful = led != nullptr ? led->isDoubtful : found.isDoubtful;
    return junction;
  }

  void setPartners(const SkeletonNode& node, const EndPairs& pairs) {
    for (const int end : node.ends) partner_[end].reset();
    for (const auto& [a, b] : pairs) {
      partner_[node.ends[a]] = node.ends[b];
      partner_[node.ends[b]] = node.ends[a];
    }
  }

  // As the user paired the ends. @param junction absent: less than three ends meet.
  void choose(const SkeletonNode& node, int choice, StrokeJunction* junction) {
    const EndPairs pairs = chosenPairs(params_.junctions[choice], edgesOf(node));
    setPartners(node, pairs);
    if (junction == nullptr) return;
    junction->pairs = pairs;
    junction->choice = choice;
  }

  static EndPairs ownPairs(const SkeletonNode& node, std::span<const EdgeFromEnd> edges,
                           std::span<const MeetingEnd> meeting, const PairingScale& scale) {
    if (const LedThrough* led = node.leading(); led != nullptr) return led->pairs;
    if (const auto alongArc = pairAlongArc(edges, meeting, scale)) return {*alongArc};
    return pairEnds(meeting, scale);
  }

  PairingScale scaleOf(const SkeletonNode& node, std::span<const MeetingEnd> meeting) const {
    PairingScale scale{node.radius, graph_.medianRadius(), params_.maxBendDeg, isOfBundles(params_)};
    // The grain of a pencil changes the widths of its strokes.
    scale.areInRows = of_ == JunctionsOf::Pen && EndRows::areIn(meeting);
    scale.narrowestPx = node.narrowestPx;
    return scale;
  }

  // Whether strokes part at both ends of an edge of which only one is led through: two may lie on one another there.
  bool isShared(int edge) const {
    if (!edge_(edge).alive || edge_(edge).ring) return false;
    return isParting(2 * edge) && isParting(2 * edge + 1);
  }
  // Whether the edge goes on beyond this end, and a branch that was left open might go on there instead.
  bool isParting(int end) const {
    const SkeletonNode* node = junctionAt(end);
    if (node == nullptr || !partner_[end]) return false;
    return std::ranges::any_of(node->ends, [&](int other) {
      return !partner_[other] && turnDeg(-ends_[end].out, ends_[other].out) <= params_.maxBendDeg;
    });
  }

  // Whether an edge between two junctions lies in their discs.
  bool isHiddenLink(int edge) const {
    if (!edge_(edge).alive || edge_(edge).ring) return false;
    const SkeletonNode *a = junctionAt(2 * edge), *b = junctionAt(2 * edge + 1);
    if (a == nullptr || b == nullptr || a == b || a->leading() != nullptr || b->leading() != nullptr) return false;
    return liesInDiscs(edge_(edge), *a, *b);
  }

  // What goes on through a hidden link is decided by the ends beyond it at either side: those that are led through it
  // give way to one that was left open where that goes straight on.
  void pairAcross(int link, std::span<const std::optional<int>> junctionOf, std::vector<StrokeJunction>& junctions) {
    const int near[2] = {2 * link, 2 * link + 1};
    std::vector<int> candidates[2];
    for (const int side : {0, 1}) {
      const SkeletonNode& node = *junctionAt(near[side]);
      if (!partner_[near[side]] || !junctionOf[*edge_(link).node[side]]) return;
      candidates[side].push_back(*partner_[near[side]]);
      for (const int end : node.ends)
        if (!partner_[end] && !isHiddenLink(end / 2)) candidates[side].push_back(end);
    }
    PairingScale scale = scaleOf(*junctionAt(near[0]), {});
    scale.nodeRadius = std::max(scale.nodeRadius, junctionAt(near[1])->radius);
    const auto costOf = [&](int a, int b) { return pairCostDeg(ends_[a], ends_[b], scale); };
    const auto bendOf = [&](int a, int b) { return turnDeg(-ends_[a].out, ends_[b].out); };
    double least = costOf(candidates[0][0], candidates[1][0]);
    int best[2] = {candidates[0][0], candidates[1][0]};
    for (const int a : candidates[0]) {
      for (const int b : candidates[1]) {
        if (!(costOf(a, b) < least)) continue;
        least = costOf(a, b);
        best[0] = a, best[1] = b;
      }
    }
    if (best[0] == candidates[0][0] && best[1] == candidates[1][0]) return;
    if (bendOf(candidates[0][0], candidates[1][0]) < kLeastBend ||
        bendOf(best[0], best[1]) > std::min(kMostStraightBend, params_.maxBendDeg))
      return;
    for (const int side : {0, 1}) {
      partner_[candidates[side][0]].reset();
      partner_[best[side]] = near[side];
      partner_[near[side]] = best[side];
      StrokeJunction& junction = junctions[*junctionOf[*edge_(link).node[side]]];
      const SkeletonNode& node = *junctionAt(near[side]);
      junction.pairs = pairsAt(node);
      std::vector<MeetingEnd> meeting;
      for (const int end : node.ends) meeting.push_back(ends_[end]);
      junction.pairings = findPairings(meeting, junction.pairs, scaleOf(node, meeting)).pairings;
    }
  }

  // The partners of a junction's ends, by their indices.
  EndPairs pairsAt(const SkeletonNode& node) const {
    EndPairs pairs;
    for (int i = 0; i < std::ssize(node.ends); ++i) {
      const std::optional<int> other = partner_[node.ends[i]];
      if (!other) continue;
      const auto k = std::ranges::find(node.ends, *other) - node.ends.begin();
      if (k > i && k < std::ssize(node.ends)) pairs.emplace_back(i, static_cast<int>(k));
    }
    return pairs;
  }

  // A width beyond the first point with a middle of its own, or where the edge ends.
  Vec2 placeOn(const EdgeFromEnd& points, int first) const {
    double arc = 0.0;
    int k = first;
    for (; k + 1 < points.size() && arc < 2.0 * kPlaceWidths * graph_.medianRadius(); ++k)
      arc += (points[k + 1].at - points[k].at).norm();
    return points[k].at;
  }

  const SkeletonNode* junctionAt(int end) const {
    const std::optional<int> node = edge_(end / 2).node[end % 2];
    if (!node) return nullptr;
    const SkeletonNode& n = graph_.nodes()[*node];
    return n.ends.size() > 1 ? &n : nullptr;
  }

  // As of a ring that touches one line or two: too short to have much beyond the discs, all of it is read.
  bool isWithinLed(int edge) const {
    const auto isLed = [&](std::optional<int> node) { return node && graph_.nodes()[*node].leading() != nullptr; };
    const SkeletonEdge& e = edge_(edge);
    return isLed(e.node[0]) && isLed(e.node[1]) && e.length < kReadWidths * 2.0 * graph_.meanRadius(edge);
  }

  std::optional<JunctionDisc> discAt(int end) const {
    const SkeletonNode* node = junctionAt(end);
    if (node == nullptr) return std::nullopt;
    return node->discOf(static_cast<int>(std::ranges::find(node->ends, end) - node->ends.begin()));
  }

  // The points of the edge entered at `end`, without those inside the discs at either side.
  void appendEdge(int end, StrokePath& path) const {
    const int n = static_cast<int>(edge_(end / 2).points.size());
    const std::optional<JunctionDisc> discs[2] = {discAt(end), discAt(end ^ 1)};
    int from = discs[0] ? ends_[end].first : 0;
    int to = discs[1] ? n - 1 - ends_[end ^ 1].first : n - 1;
    if (from > to) from = to = std::clamp((from + to) / 2, 0, n - 1);
    const bool isRead = isWithinLed(end / 2);
    for (int k = from; k <= to; ++k) {
      StrokePathPoint p = point(end, k);
      for (const std::optional<JunctionDisc>& disc : discs) {
        if (disc && !isRead && (p.at - disc->centre).norm() < disc->radius + kBesideDisc * graph_.medianRadius())
          p.part = StrokePart::Junction;
      }
      path.points.push_back(p);
    }
  }

  // From the last point of the stroke path through the junction to the edge entered at `to`, or, without one, to the
  // middle of the stroke it ends in.
  void appendThrough(int from, std::optional<int> to, StrokePath& path) const {
    const MeetingEnd& p = ends_[from];
    const float radius = path.points.back().radius;
    const auto add = [&](const Vec2& at) { path.points.push_back({at, radius, StrokePart::Junction}); };
    const Vec2 start = path.points.back().at;
    if (to) {
      const MeetingEnd& q = ends_[*to];
      for (const Vec2& at : cubicBetween(start, -p.out, point(*to, q.first).at, q.out)) add(at);
      return;
    }
    const JunctionDisc disc = *discAt(from);
    const double along = (disc.centre - start).dot(-p.out);
    const double length = std::clamp(along, 0.0, 2.0 * disc.radius);
    for (int k = 1; k <= static_cast<int>(length); ++k) add(start - static_cast<double>(k) * p.out);
    if (length > std::floor(length) + kLeastLastStepPx) add(start - length * p.out);
  }

  StrokePath follow(int start, std::vector<bool>& used) const {
    StrokePath path;
    if (edge_(start / 2).ring) {
      used[start / 2] = true;
      path.closed = true;
      path.points = edge_(start / 2).points;
      return path;
    }
    if (!partner_[start] && junctionAt(start)) {
      path.tip[0] = false;
      StrokePath lead;
      lead.points.push_back(point(start, ends_[start].first));
      appendThrough(start, std::nullopt, lead);
      path.points.assign(lead.points.rbegin(), lead.points.rend() - 1);
    }
    for (int end = start;;) {
      used[end / 2] = true;
      appendEdge(end, path);
      const int far = end ^ 1;
      const std::optional<int> next = partner_[far];
      if (!next) {
        path.tip[1] = junctionAt(far) == nullptr;
        if (!path.tip[1]) appendThrough(far, std::nullopt, path);
        return path;
      }
      appendThrough(far, next, path);
      if (used[*next / 2]) {
        path.closed = true;
        return path;
      }
      end = *next;
    }
  }

  const SkeletonGraph& graph_;
  const EdgeParams& params_;
  JunctionsOf of_;
  std::vector<MeetingEnd> ends_;             // per end of an edge
  std::vector<std::optional<int>> partner_;  // the end that an end goes on with
};

}  // namespace

StrokePathSet findPathsAndJunctions(const BitImage& skeleton, const BitImage& ink, const EdgeParams& params,
                                    const RunContext& context, JunctionsOf of) {
  SkeletonGraph graph(skeletonChains(skeleton), ink);
  if (context.isCancelled()) return {};
  pruneSpurs(graph, params.spurFactor);
  if (isOfBundles(params)) of = JunctionsOf::Bundles;
  mergeJunctions(graph, of, params.junctions);
  if (context.isCancelled()) return {};
  return StrokePathMaker(graph, params, of).make();
}

std::vector<StrokePath> findStrokePaths(const BitImage& skeleton, const BitImage& ink, const EdgeParams& params,
                                        const RunContext& context) {
  return findPathsAndJunctions(skeleton, ink, params, context).paths;
}

}  // namespace batten
