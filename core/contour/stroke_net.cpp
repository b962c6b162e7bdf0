// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/stroke_net.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/contour/polyline_tools.h"

namespace batten {
namespace {

constexpr double kMaxBendDeg = 40.0;     // a line goes on where it bends no more
constexpr double kMissDeg = 20.0;        // what a miss by the distance costs
constexpr double kShortDeg = 30.0;       // what going on with an overshoot costs
constexpr double kSpur = 2.0;            // distances: shorter things are overshoots
constexpr double kShared = 6.0;          // distances: two lines share no longer way
constexpr double kSharedBendDeg = 25.0;  // and go on as straight as this
constexpr double kLook = 1.5;            // distances over which an end is looked at
constexpr double kOvershoot = 7.0;       // distances: what a single stroke may go beyond where it leaves the others
constexpr float kSingleWeight = 1.5f;
constexpr double kOvershootShare = 0.2;  // and of the line that it leaves
constexpr double kLeastLookPx = 12.0;
constexpr double kJointSmoothing = 3.0;  // points
constexpr int kJointReach = 12;          // points on either side

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double angleDeg(const Vec2& a, const Vec2& b) {
  return std::atan2(std::abs(cross(a, b)), a.dot(b)) * 180.0 / std::numbers::pi;
}

void reverse(MeanLine& line) {
  std::reverse(line.points.begin(), line.points.end());
  std::reverse(line.tangent.begin(), line.tangent.end());
  for (Vec2& t : line.tangent) t = -t;
  std::reverse(line.source.begin(), line.source.end());
  std::reverse(line.weight.begin(), line.weight.end());
}

MeanLine stretch(const MeanLine& line, int from, int to) {
  const auto cut = [&](const auto& v) { return std::decay_t<decltype(v)>(v.begin() + from, v.begin() + to + 1); };
  MeanLine p;
  p.points = cut(line.points);
  p.tangent = cut(line.tangent);
  p.source = cut(line.source);
  p.weight = cut(line.weight);
  return p;
}

void dropBack(MeanLine& line) {
  line.points.pop_back();
  line.tangent.pop_back();
  line.source.pop_back();
  line.weight.pop_back();
}

// The two parts of a line meet before `joint` to within a few pixels: a little smoothing there.
void smoothJoint(std::vector<Vec2>& points, int joint) {
  const auto from = points.begin() + std::max(0, joint - kJointReach),
             to = points.begin() + std::min(static_cast<int>(points.size()), joint + kJointReach);
  std::ranges::copy(smoothPolyline(std::vector<Vec2>(from, to), false, kJointSmoothing), from);
}

// `more` goes on from the end of `line`; where both cover the same way, `line` gives in.
void append(MeanLine& line, const MeanLine& more, double mostPx) {
  double given = 0.0;
  while (line.points.size() > 3 && given < mostPx &&
         (more.points.front() - line.points.back()).dot(more.tangent.front()) < 1.0) {
    given += (line.points.back() - line.points[line.points.size() - 2]).norm();
    dropBack(line);
  }
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  const int joint = static_cast<int>(line.points.size());
  add(line.points, more.points);
  add(line.tangent, more.tangent);
  add(line.source, more.source);
  add(line.weight, more.weight);
  smoothJoint(line.points, joint);
}

// The end goes on at the beginning.
void close(MeanLine& line, double mostPx) {
  double given = 0.0;
  while (line.points.size() > 3 && given < mostPx &&
         (line.points.front() - line.points.back()).dot(line.tangent.front()) < 1.0) {
    given += (line.points.back() - line.points[line.points.size() - 2]).norm();
    dropBack(line);
  }
  line.closed = true;
  // Half a turn brings the seam where there are points on both sides.
  const auto half = static_cast<std::ptrdiff_t>(line.points.size() / 2);
  const auto turn = [half](auto& v) { std::rotate(v.begin(), v.begin() + half, v.end()); };
  turn(line.points);
  turn(line.tangent);
  turn(line.source);
  turn(line.weight);
  smoothJoint(line.points, static_cast<int>(line.points.size()) - static_cast<int>(half));
}

// The line ends at a place near its end: what goes beyond is cut off.
void endAt(MeanLine& line, int side, const Vec2& place) {
  if (side == 0) reverse(line);
  const Vec2 out = line.tangent[line.tangent.size() / 2 < line.tangent.size() - 4 ? line.tangent.size() - 4
                                                                                  : line.tangent.size() - 1];
  while (line.points.size() > 3 && (place - line.points.back()).dot(out) < 0.5) dropBack(line);
  line.points.push_back(place);
  line.tangent.push_back(line.tangent.back());
  line.source.push_back(line.source.back());
  line.weight.push_back(line.weight.back());
  if (side == 0) reverse(line);
}

// A stretch of a line between two nodes; its ends are numbered 2 * leg + side.
struct Leg {
  MeanLine line;
  int node[2] = {-1, -1};
  double length = 0.0;
  bool alive = true;
};

// How a leg meets its node: the place and the direction away from it, and that of the leg beyond its first points.
struct EndLook {
  Vec2 at = Vec2::Zero(), out = Vec2::Zero();
};

// The end itself and the direction out of the leg, seen over some of its points but the first: these may be a hook.
EndLook endOf(const MeanLine& line, int end, double distance) {
  const int n = static_cast<int>(line.points.size());
  const int skip = static_cast<int>(std::min(0.5 * distance, 0.25 * n));
  const double reach = std::max(kLeastLookPx, std::min(kLook * distance, 0.5 * n));
  std::vector<double> s;
  std::vector<Vec2> p;
  for (int k = skip; k < n && k - skip <= reach; ++k) {
    s.push_back(k);
    p.push_back(line.points[at(end % 2 == 0 ? k : n - 1 - k)]);
  }
  const LocalQuadratic fit = fitLocalQuadratic(s, p, {}, static_cast<double>(p.size()) >= 0.5 * reach ? 2 : 1);
  EndLook e;
  if (fit.order < 1 || !(fit.r1.norm() > 0.0)) {
    e.at = end % 2 == 0 ? line.points.front() : line.points.back();
    e.out = end % 2 == 0 ? line.tangent.front() : Vec2(-line.tangent.back());
    return e;
  }
  return {fit.r0, fit.r1.normalized()};
}

class StrokeNet {
 public:
  StrokeNet(StrokePieces pieces, double distancePx) : distance_(std::max(1.0, distancePx)) { build(std::move(pieces)); }

  std::vector<MeanLine> lines(const RunContext& context) {
    dropLoops();
    for (int round = 0; round < 3; ++round) {
      if (context.isCancelled()) return {};
      dropSpurs();
      spliceAll();
    }
    contractShared();
    dropSpurs();
    spliceAll();
    if (context.isCancelled()) return {};
    for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) pairAt(n);
    dropLeftOvers();
    std::vector<MeanLine> found = follow();
    for (MeanLine& line : found) closeOverlap(line);
    joinFreeEnds(found);
    std::erase_if(found, [](const MeanLine& l) { return l.points.size() < 3; });
    return found;
  }

 private:
  void build(StrokePieces pieces);
  void addLeg(MeanLine line, int from, int to) {
    Leg leg;
    leg.length = polylineLength(line.points, line.closed);
    leg.line = std::move(line);
    leg.node[0] = from;
    leg.node[1] = to;
    const int number = static_cast<int>(legs_.size());
    if (from >= 0) nodes_[at(from)].push_back(2 * number);
    if (to >= 0) nodes_[at(to)].push_back(2 * number + 1);
    legs_.push_back(std::move(leg));
  }

  EndLook look(int end) const { return endOf(legs_[at(end / 2)].line, end, distance_); }

  // Of going from one end of a leg to another; < 0: no.
  double cost(int a, int b, double maxBendDeg) const {
    const EndLook p = look(a), q = look(b);
    const double bend = angleDeg(-p.out, q.out);
    if (bend > maxBendDeg) return -1.0;
    const Vec2 d = q.at - p.at;
    const double miss = 0.5 * (std::abs(cross(p.out, d)) + std::abs(cross(q.out, d)));
    return bend + kMissDeg * miss / distance_;
  }

  bool isFree(int end) const { return legs_[at(end / 2)].node[end % 2] < 0; }
  bool isSpur(int end) const { return isFree(end ^ 1) && legs_[at(end / 2)].length < kSpur * distance_; }

  void removeLeg(int leg) {
    for (const int side : {0, 1})
      if (legs_[at(leg)].node[side] >= 0) std::erase(nodes_[at(legs_[at(leg)].node[side])], 2 * leg + side);
    legs_[at(leg)] = Leg{};
    legs_[at(leg)].alive = false;
  }

  // A way from a node to itself that is no longer than a spur is nothing.
  void dropLoops() {
    for (int i = 0; i < static_cast<int>(legs_.size()); ++i) {
      const Leg& l = legs_[at(i)];
      if (l.alive && l.node[0] >= 0 && l.node[0] == l.node[1] && l.length < 2.0 * kSpur * distance_) removeLeg(i);
    }
  }

  // Overshoots go where others go on without them, the shortest first.
  void dropSpurs() {
    std::vector<int> order;
    for (int i = 0; i < static_cast<int>(legs_.size()); ++i)
      if (legs_[at(i)].alive && isFree(2 * i) != isFree(2 * i + 1)) order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return legs_[at(a)].length < legs_[at(b)].length; });
    for (const int leg : order) {
      const int end = isFree(2 * leg) ? 2 * leg + 1 : 2 * leg;
      if (!isSpur(end)) continue;
      const std::vector<int>& ends = nodes_[at(legs_[at(leg)].node[end % 2])];
      bool others = false;
      for (const int a : ends)
        for (const int b : ends)
          others = others || (a < b && a / 2 != leg && b / 2 != leg && cost(a, b, kMaxBendDeg) >= 0.0);
      if (others) removeLeg(leg);
    }
  }

  void spliceAll() {
    for (int n = 0; n < static_cast<int>(nodes_.size()); ++n) splice(n);
  }

  // Two legs that meet alone and go on as one become one.
  void splice(int node) {
    std::vector<int>& ends = nodes_[at(node)];
    if (ends.size() != 2 || ends[0] / 2 == ends[1] / 2) return;
    const int a = ends[0], b = ends[1];
    if (cost(a, b, kMaxBendDeg) < 0.0) return;
    ends.clear();
    Leg first = legs_[at(a / 2)], second = legs_[at(b / 2)];
    if (a % 2 == 0) {
      reverse(first.line);
      std::swap(first.node[0], first.node[1]);
    }
    if (b % 2 == 1) {
      reverse(second.line);
      std::swap(second.node[0], second.node[1]);
    }
    removeLeg(a / 2);
    removeLeg(b / 2);
    append(first.line, second.line, kSpur * distance_);
    addLeg(std::move(first.line), first.node[0], second.node[1]);
  }

  // Two lines that cross at a small angle run on one line for a while: the way between is taken out, and they go on as
  // they came.
  void contractShared() {
    for (int i = 0; i < static_cast<int>(legs_.size()); ++i) {
      const Leg& l = legs_[at(i)];
      if (!l.alive || l.node[0] < 0 || l.node[1] < 0 || l.node[0] == l.node[1] || l.length > kShared * distance_)
        continue;
      std::vector<int> one = nodes_[at(l.node[0])], two = nodes_[at(l.node[1])];
      std::erase(one, 2 * i);
      std::erase(two, 2 * i + 1);
      if (one.size() != 2 || two.size() != 2) continue;
      const auto together = [&](int a, int b) {
        const double c = a / 2 == b / 2 ? -1.0 : cost(a, b, kSharedBendDeg);
        return c < 0.0 ? std::numeric_limits<double>::infinity() : c;
      };
      const double straight = together(one[0], two[0]) + together(one[1], two[1]);
      const double across = together(one[0], two[1]) + together(one[1], two[0]);
      if (!(std::min(straight, across) < 2.0 * kSharedBendDeg)) continue;
      const int from = l.node[0], to = l.node[1];
      removeLeg(i);
      for (const int end : nodes_[at(to)]) {
        legs_[at(end / 2)].node[end % 2] = from;
        nodes_[at(from)].push_back(end);
      }
      nodes_[at(to)].clear();
    }
  }

  void pairAt(int node) {
    const std::vector<int>& ends = nodes_[at(node)];
    struct Option {
      double cost;
      int a, b;
    };
    std::vector<Option> options;
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = i + 1; j < ends.size(); ++j) {
        double c = cost(ends[i], ends[j], kMaxBendDeg);
        if (c < 0.0) continue;
        for (const int end : {ends[i], ends[j]})
          if (isSpur(end)) c += kShortDeg * (1.0 - legs_[at(end / 2)].length / (kSpur * distance_));
        options.push_back({c, ends[i], ends[j]});
      }
    std::stable_sort(options.begin(), options.end(), [](const Option& x, const Option& y) { return x.cost < y.cost; });
    partner_.resize(2 * legs_.size(), -1);
    for (const Option& o : options) {
      if (partner_[at(o.a)] >= 0 || partner_[at(o.b)] >= 0) continue;
      partner_[at(o.a)] = o.b;
      partner_[at(o.b)] = o.a;
    }
  }

  // [px] of the line that goes through a leg.
  double lineLength(int leg) const {
    double sum = legs_[at(leg)].length;
    for (const int side : {0, 1})
      for (int end = partner_[at(2 * leg + side)]; end >= 0 && end / 2 != leg; end = partner_[at(end ^ 1)])
        sum += legs_[at(end / 2)].length;
    return sum;
  }

  // The outer half of a leg that ends free at `end` was drawn once.
  bool isSingle(int end) const {
    const std::vector<float>& weight = legs_[at(end / 2)].line.weight;
    const std::size_t half = weight.size() / 2;
    std::vector<float> outer(weight.begin(), weight.end());
    if (end % 2 == 1) std::reverse(outer.begin(), outer.end());
    outer.resize(std::max<std::size_t>(1, half));
    std::nth_element(outer.begin(), outer.begin() + static_cast<std::ptrdiff_t>(outer.size() / 2), outer.end());
    return outer[outer.size() / 2] < kSingleWeight;
  }

  // A single stroke that leaves a longer line smoothly and ends.
  bool isOvershoot(int leg) const {
    const Leg& l = legs_[at(leg)];
    const int end = l.node[0] >= 0 ? 2 * leg : 2 * leg + 1;
    if (l.node[end % 2] < 0 || !isFree(end ^ 1) || partner_[at(end)] >= 0 || l.length > kOvershoot * distance_)
      return false;
    for (const int other : nodes_[at(l.node[end % 2])])
      if (other / 2 != leg && partner_[at(other)] >= 0 && cost(end, other, kMaxBendDeg) >= 0.0 &&
          l.length <= kOvershootShare * lineLength(other / 2))
        return isSingle(end ^ 1);
    return false;
  }

  // What nothing goes on with: overshoots and ways between two lines that nearly touch.
  void dropLeftOvers() {
    partner_.resize(2 * legs_.size(), -1);
    for (int i = 0; i < static_cast<int>(legs_.size()); ++i) {
      const Leg& l = legs_[at(i)];
      if (!l.alive || (l.node[0] < 0 && l.node[1] < 0)) continue;
      const bool alone = partner_[at(2 * i)] < 0 && partner_[at(2 * i + 1)] < 0;
      if ((alone && l.length < kSpur * distance_) || isOvershoot(i)) legs_[at(i)].alive = false;
    }
  }

  std::vector<MeanLine> follow() {
    std::vector<MeanLine> found;
    std::vector<bool> used(legs_.size(), false);
    // First the lines that begin somewhere, then the closed ones.
    for (int pass = 0; pass < 2; ++pass)
      for (int leg = 0; leg < static_cast<int>(legs_.size()); ++leg)
        for (int side = 0; side < 2; ++side)
          if (legs_[at(leg)].alive && !used[at(leg)] && (pass == 1 || partner_[at(2 * leg + side)] < 0))
            found.push_back(followFrom(2 * leg + side, used));
    return found;
  }

  MeanLine followFrom(int start, std::vector<bool>& used) const {
    MeanLine line;
    for (int end = start;;) {
      used[at(end / 2)] = true;
      MeanLine next = legs_[at(end / 2)].line;
      if (end % 2 == 1) reverse(next);
      if (line.points.empty()) {
        line = std::move(next);
      } else {
        append(line, next, kSpur * distance_);
      }
      end = partner_[at(end ^ 1)];
      if (end < 0) return line;
      if (used[at(end / 2)]) {
        close(line, kSpur * distance_);
        return line;
      }
    }
  }

  // A loop drawn beyond its start: what runs along the start goes, and the loop is closed.
  void closeOverlap(MeanLine& line) const {
    const int n = static_cast<int>(line.points.size());
    const int apart = static_cast<int>(4.0 * distance_) + 30;
    if (line.closed || n < 2 * apart) return;
    int best = -1;
    double nearest = std::max(4.0, 0.5 * distance_);
    for (int i = n - 1; i >= std::max(apart, n / 2); --i) {
      const double d = (line.points[at(i)] - line.points.front()).norm();
      if (d >= nearest || line.tangent[at(i)].dot(line.tangent.front()) < 0.7) continue;
      nearest = d;
      best = i;
    }
    if (best < 0) return;
    line = stretch(line, 0, best);
    close(line, kSpur * distance_);
  }

  void joinFreeEnds(std::vector<MeanLine>& lines) const;

  double distance_;
  std::vector<Leg> legs_;
  std::vector<std::vector<int>> nodes_;
  std::vector<int> partner_;
};

// Cut the pieces where others are attached; what is nearer than the distance along a piece is one node.
void StrokeNet::build(StrokePieces pieces) {
  struct Mark {
    int index = 0, attachment = 0;
    bool end = false;  // of the piece itself
  };
  const auto count = pieces.pieces.size();
  std::vector<std::vector<Mark>> marks(count);
  std::vector<int> parent(pieces.attachments.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  for (int a = 0; a < static_cast<int>(pieces.attachments.size()); ++a) {
    const StrokePieces::Attachment& m = pieces.attachments[at(a)];
    const int last = static_cast<int>(pieces.pieces[at(m.piece)].points.size()) - 1;
    marks[at(m.piece)].push_back({m.side == 0 ? 0 : last, a, true});
    marks[at(m.onto)].push_back({m.index, a, false});
  }
  struct Cut {
    int index = 0, attachment = 0;
  };
  std::vector<std::vector<Cut>> cuts(count);
  const int together = static_cast<int>(distance_), snap = static_cast<int>(std::max(6.0, 0.5 * distance_));
  for (std::size_t p = 0; p < count; ++p) {
    auto& m = marks[p];
    const int last = static_cast<int>(pieces.pieces[p].points.size()) - 1;
    std::stable_sort(m.begin(), m.end(), [](const Mark& a, const Mark& b) { return a.index < b.index; });
    for (std::size_t i = 0; i < m.size();) {
      std::size_t k = i;
      long sum = 0;
      int own = -1;
      for (; k < m.size() && (k == i || m[k].index - m[k - 1].index <= together); ++k) {
        // Both ends of a short piece are two nodes.
        if (own >= 0 && m[k].end && m[k].index != own) break;
        sum += m[k].index;
        if (m[k].end) own = m[k].index;
        parent[at(root(m[k].attachment))] = root(m[i].attachment);
      }
      int index = own >= 0 ? own : static_cast<int>(sum / static_cast<long>(k - i));
      if (!pieces.pieces[p].closed && index < snap) index = 0;
      if (!pieces.pieces[p].closed && index > last - snap) index = last;
      cuts[p].push_back({index, m[i].attachment});
      i = k;
    }
  }
  std::vector<int> number(parent.size(), -1);
  const auto nodeOf = [&](int attachment) {
    int& n = number[at(root(attachment))];
    if (n < 0) {
      n = static_cast<int>(nodes_.size());
      nodes_.emplace_back();
    }
    return n;
  };
  for (std::size_t p = 0; p < count; ++p) {
    MeanLine& line = pieces.pieces[p];
    std::vector<Cut> c = cuts[p];
    if (c.empty()) {
      addLeg(std::move(line), -1, -1);
      continue;
    }
    if (line.closed) {
      const int first = c.front().index;
      const auto turn = [first](auto& v) { std::rotate(v.begin(), v.begin() + first, v.end()); };
      turn(line.points);
      turn(line.tangent);
      turn(line.source);
      turn(line.weight);
      line.closed = false;
      for (Cut& cut : c) cut.index -= first;
      c.push_back({static_cast<int>(line.points.size()) - 1, c.front().attachment});
    }
    const int last = static_cast<int>(line.points.size()) - 1;
    int from = 0, node = -1;
    for (const Cut& cut : c) {
      if (cut.index - from >= 2) addLeg(stretch(line, from, cut.index), node, nodeOf(cut.attachment));
      from = cut.index;
      node = nodeOf(cut.attachment);
    }
    if (last - from >= 2) addLeg(stretch(line, from, last), node, -1);
  }
}

// Free ends that look at each other over no more than the distance: the nearest first.
void StrokeNet::joinFreeEnds(std::vector<MeanLine>& lines) const {
  for (;;) {
    struct Best {
      int a = -1, b = -1;
      double cost = 0.0;
    } best;
    const int count = 2 * static_cast<int>(lines.size());
    for (int a = 0; a < count; ++a) {
      if (lines[at(a / 2)].points.size() < 3 || lines[at(a / 2)].closed) continue;
      for (int b = a + 1; b < count; ++b) {
        const MeanLine& other = lines[at(b / 2)];
        if (other.points.size() < 3 || other.closed) continue;
        if (a / 2 == b / 2 && static_cast<double>(other.points.size()) < 4.0 * distance_ + 30.0) continue;
        const EndLook p = endOf(lines[at(a / 2)], a, distance_), q = endOf(other, b, distance_);
        const Vec2 gap = q.at - p.at;
        if (gap.norm() > distance_ || angleDeg(-p.out, q.out) > kMaxBendDeg) continue;
        const double miss = 0.5 * (std::abs(cross(p.out, gap)) + std::abs(cross(q.out, gap)));
        if (miss > 0.6 * distance_) continue;
        const double cost = gap.norm() + miss;
        if (best.a < 0 || cost < best.cost) best = {a, b, cost};
      }
    }
    if (best.a < 0) return;
    MeanLine& first = lines[at(best.a / 2)];
    MeanLine& second = lines[at(best.b / 2)];
    if (best.a / 2 == best.b / 2) {
      close(first, kSpur * distance_);
      continue;
    }
    if (best.a % 2 == 0) reverse(first);
    if (best.b % 2 == 1) reverse(second);
    append(first, second, kSpur * distance_);
    second = MeanLine{};
  }
}

}  // namespace

std::vector<MeanLine> joinPieces(StrokePieces pieces, double distancePx, const RunContext& context) {
  return StrokeNet(std::move(pieces), distancePx).lines(context);
}

void meetAtTurns(std::vector<MeanLine>& lines, const std::vector<Vec2>& turns, double distance) {
  for (const Vec2& turn : turns) {
    std::vector<std::pair<double, int>> near;
    for (int e = 0; e < 2 * static_cast<int>(lines.size()); ++e) {
      const MeanLine& l = lines[at(e / 2)];
      if (l.closed || l.points.size() < 3) continue;
      const double d = ((e % 2 == 0 ? l.points.front() : l.points.back()) - turn).norm();
      if (d <= distance) near.emplace_back(d, e);
    }
    if (near.size() < 2) continue;
    std::sort(near.begin(), near.end());
    const int a = near[0].second, b = near[1].second;
    const EndLook p = endOf(lines[at(a / 2)], a, distance), q = endOf(lines[at(b / 2)], b, distance);
    // Where the lines would meet; at a small angle, or if they would have to go far for it, halfway.
    const double sine = cross(p.out, q.out);
    Vec2 corner = 0.5 * (p.at + q.at);
    if (std::abs(sine) > 0.3) {
      const Vec2 meet = p.at + cross(Vec2(q.at - p.at), q.out) / sine * p.out;
      if ((meet - p.at).norm() <= distance && (meet - q.at).norm() <= distance) corner = meet;
    }
    for (const int e : {a, b}) endAt(lines[at(e / 2)], e % 2, corner);
  }
}

}  // namespace batten
