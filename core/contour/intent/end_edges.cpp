// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/end_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/angle.h"
#include "core/base/vec2.h"
#include "core/contour/intent/merge_shares.h"
#include "core/contour/merge/stroke_lines.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr double kEndReach = 8.0, kEndReachLater = 10.0;  // [stroke widths] those of bundles lie scattered
constexpr double kNoCandidateDeg = 180.0;  // counts as the cost of a rival where there is none: it turns right back
constexpr double kBendFrom = 12.0, kBendMiddle = 5.0;    // of the chord before the one that gives the direction
constexpr double kLeastBendChord = 3.0;                  // samples: a shorter one has no direction, as of a stroke
constexpr double kLongFrom = 25.0, kLongTo = 2.0;        // samples inside of the tip: where a bundle goes on the whole
constexpr double kNearArms = 2.5, kNearArmsLater = 3.0;  // [stroke widths] ends as near are arms of one junction
constexpr double kSpreadsInside = 2.0;                   // so many spreads farther in the whole of a bundle is seen
constexpr double kSamePlace = 1e-9;                      // the tip of a piece and that of its strip
constexpr double kLinkReach = 4.0;     // [stroke widths] and the spread: a link so near to a bundle's tip is of its end
constexpr double kTouchingEnds = 1.5;  // the way between them has no direction

// Cost of a pair beside its turn. A gap weighs as a turn of so many degrees per stroke width, less between bundles,
// whose ends lie scattered; the way across it counts half as much as the turn itself, and from kWholeMissGap on, as a
// shorter way has hardly a direction. Bundles that the trace links have one reason more to go on.
constexpr double kGapCostDeg = 4.0, kGapCostLaterDeg = 3.0, kMissShare = 0.5, kWholeMissGap = 2.0, kLinkGainDeg = 10.0;

// Of the features. The weights (intent_weights.h) were learned with these units and caps: they change together only.
constexpr double kEndAngleUnitDeg = 30.0, kMissUnitDeg = 60.0;
constexpr double kNoWidth = 0.5;                               // [stroke widths] added, for the logarithm of nothing
constexpr double kFirstBendDeg = 20.0, kSecondBendDeg = 40.0;  // from where on a turn weighs more, and more again
constexpr double kUnlikeBendDeg = 25.0, kLongBendDeg = 30.0;   // the same of other angles
constexpr double kMostLinkedTurnDeg = 150.0, kMostLongTurnDeg = 120.0, kMostAdvantageDeg = 90.0;  // caps
constexpr double kBackDeg = 120.0;            // what turns more runs back
constexpr int kMostArms = 6, kMostLinks = 4;  // caps

double signedDeg(const Vec2& a, const Vec2& b) { return kDegPerRad * std::atan2(cross(a, b), a.dot(b)); }

const Strip& stripOf(const EndView& v, int end) { return v.view.strips[end / 2]; }

// The chord reaches farther in, the wider the bundle: its very end is a few strokes only.
double farInside(const EndView& v, int end) {
  return kDirectionFrom + (v.view.isLater ? kSpreadsInside * stripOf(v, end).spread : 0.0);
}
Vec2 outOf(const EndView& v, int end) {
  return directionOut(stripOf(v, end), end % 2, farInside(v, end), kDirectionTo);
}

// [deg] By which the strip bends towards its end, in the direction out of it.
double bendAt(const EndView& v, int end) {
  const Strip& s = stripOf(v, end);
  const double scale = farInside(v, end) / kDirectionFrom;
  if (s.length() < kBendMiddle * scale + kLeastBendChord) return 0.0;
  return signedDeg(directionOut(s, end % 2, kBendFrom * scale, kBendMiddle * scale), outOf(v, end));
}

void setGeometry(EndPair& p, const EndView& v) {
  const Vec2 outA = outOf(v, p.a), outB = outOf(v, p.b);
  const Vec2 chord = tipOf(stripOf(v, p.b), p.b % 2) - tipOf(stripOf(v, p.a), p.a % 2);
  p.gap = chord.norm();
  p.turnDeg = turnDeg(outA, -outB);
  p.offset = std::max(std::abs(cross(outA, chord)), std::abs(cross(outB, chord)));
}

// [deg] Between the two ends and the chord from one to the other, summed.
double missDeg(const EndPair& p, const EndView& v) {
  if (p.gap < kTouchingEnds) return p.turnDeg;
  const Vec2 chord = tipOf(stripOf(v, p.b), p.b % 2) - tipOf(stripOf(v, p.a), p.a % 2);
  return turnDeg(outOf(v, p.a), chord) + turnDeg(outOf(v, p.b), -chord);
}

// Counts the links of the trace between members that lie at both ends.
void setLinks(std::vector<EndPair>& pairs, const EndView& v) {
  std::vector<std::optional<int>> stripOfPiece(v.pieces.pieces.size());
  for (int s = 0; s < std::ssize(v.view.strips); ++s)
    for (const int piece : v.view.strips[s].members) stripOfPiece[piece] = s;
  std::map<std::pair<int, int>, std::vector<const TraceLink*>> between;
  for (const TraceLink& link : v.pieces.links) {
    const std::optional<int> a = stripOfPiece[link.from / 2], b = stripOfPiece[link.to / 2];
    if (a && b && *a != *b) between[std::minmax(*a, *b)].push_back(&link);
  }
  for (EndPair& p : pairs) {
    const auto found = between.find(std::minmax(p.a / 2, p.b / 2));
    if (found == between.end()) continue;
    for (const TraceLink* link : found->second) {
      const Vec2& at = tipOf(v.pieces.pieces[link->to / 2].strip, link->to % 2);
      const auto isAt = [&](int end) {
        const Strip& s = stripOf(v, end);
        const double reach = v.view.isLater ? kLinkReach + kSpreadsInside * s.spread : 0.0;
        return (tipOf(s, end % 2) - at).norm() <= reach + kSamePlace;
      };
      if (!isAt(p.a) || !isAt(p.b)) continue;
      if (!v.view.isLater && !((link->from == p.a && link->to == p.b) || (link->from == p.b && link->to == p.a)))
        continue;
      ++p.links;
      p.corners += link->isCorner ? 1 : 0;
    }
  }
}

void setRivals(std::vector<EndPair>& pairs, const EndView& v) {
  std::map<int, std::vector<const EndPair*>> at;
  for (const EndPair& p : pairs) {
    at[p.a].push_back(&p);
    at[p.b].push_back(&p);
  }
  const double near = v.view.isLater ? kNearArmsLater : kNearArms;
  for (EndPair& p : pairs) {
    double least[2] = {kNoCandidateDeg, kNoCandidateDeg};
    for (const int which : {0, 1}) {
      for (const EndPair* other : at[which == 0 ? p.a : p.b]) {
        if (other == &p) continue;
        least[which] = std::min(least[which], other->cost);
        p.arms += other->gap < near ? 1 : 0;
      }
    }
    p.bestOther = std::min(least[0], least[1]);
    p.worseOther = std::max(least[0], least[1]);
  }
}

// What bundles show beside. `gap`, `offset`: logarithms.
std::vector<double> laterEndFeatures(const EndPair& p, const EndView& v, bool isBesideToo, double gap, double offset) {
  const Strip &a = stripOf(v, p.a), &b = stripOf(v, p.b);
  const double longTurn =
      turnDeg(directionOut(a, p.a % 2, kLongFrom, kLongTo), -directionOut(b, p.b % 2, kLongFrom, kLongTo));
  const double w = std::log(a.spread + b.spread + 1.0), beside = isBesideToo ? 1.0 : 0.0;
  const auto fewer = static_cast<double>(std::min(a.members.size(), b.members.size()));
  const auto more = static_cast<double>(std::max(a.members.size(), b.members.size()));
  return {static_cast<double>(std::min(p.links, kMostLinks)),
          std::min(longTurn, kMostLongTurnDeg) / kEndAngleUnitDeg,
          std::max(0.0, longTurn - kLongBendDeg) / kEndAngleUnitDeg,
          w,
          std::abs(a.spread - b.spread) / (a.spread + b.spread + 1.0),
          std::log(fewer),
          std::log(more),
          beside,
          beside * offset,
          offset - w,
          gap - w};
}

}  // namespace

const Vec2& tipOf(const Strip& strip, int side) {
  return side == 0 ? strip.samples.front().at : strip.samples.back().at;
}

Vec2 directionOut(const Strip& strip, int side, double fromInside, double toInside) {
  const int last = strip.count() - 1;
  const int from = std::min(last, static_cast<int>(std::lround(fromInside)));
  const int to = std::min(std::max(0, from - 1), static_cast<int>(std::lround(toInside)));
  const auto at = [&](int inside) { return strip.samples[side == 0 ? inside : last - inside].at; };
  const Vec2 chord = at(to) - at(from);
  const double length = chord.norm();
  if (length > 0.0) return chord / length;
  return side == 0 ? Vec2(-strip.samples.front().tangent) : strip.samples.back().tangent;
}

std::vector<EndPair> findEndPairs(const EndView& v, const RunContext& context) {
  const double reach = v.view.isLater ? kEndReachLater : kEndReach;
  PointGrid<int> grid(reach);
  std::vector<int> ends;
  for (int s = 0; s < std::ssize(v.view.strips); ++s) {
    if (v.view.strips[s].closed) continue;
    for (const int side : {0, 1}) {
      ends.push_back(2 * s + side);
      grid.add(tipOf(v.view.strips[s], side), ends.back());
    }
  }
  std::vector<EndPair> pairs;
  for (const int end : ends) {
    if (context.isCancelled()) return {};
    const Vec2& at = tipOf(stripOf(v, end), end % 2);
    grid.around(at, [&](int other) {
      if (other / 2 <= end / 2 || (tipOf(stripOf(v, other), other % 2) - at).norm() > reach) return;
      pairs.push_back({.a = end, .b = other});
    });
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const EndPair& p, const EndPair& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  for (EndPair& p : pairs) setGeometry(p, v);
  setLinks(pairs, v);
  for (EndPair& p : pairs) {
    const double linked = p.links > 0 ? 1.0 : 0.0;
    p.cost = p.turnDeg + kMissShare * missDeg(p, v) * std::min(1.0, p.gap / kWholeMissGap) +
             (v.view.isLater ? kGapCostLaterDeg * p.gap - kLinkGainDeg * linked : kGapCostDeg * p.gap);
  }
  setRivals(pairs, v);
  return pairs;
}

std::vector<double> endFeatures(const EndPair& p, const EndView& v, bool isBesideToo) {
  const Strip &a = stripOf(v, p.a), &b = stripOf(v, p.b);
  const double linked = p.links > 0 ? 1.0 : 0.0, corner = p.links > 0 && p.corners == p.links ? 1.0 : 0.0;
  const double t = p.turnDeg / kEndAngleUnitDeg, g = v.view.scale;
  const double gap = std::log(p.gap + kNoWidth), offset = std::log(p.offset + kNoWidth);
  const double best = p.cost <= p.bestOther ? 1.0 : 0.0, alone = p.arms == 0 ? 1.0 : 0.0;
  const auto advantage = [&](double other) {
    return std::clamp(other - p.cost, -kMostAdvantageDeg, kMostAdvantageDeg) / kEndAngleUnitDeg;
  };
  const double bendA = bendAt(v, p.a), bendB = bendAt(v, p.b);
  // In the direction of travel from a into b.
  const double expected = 0.5 * (bendA - bendB);
  const double unlike = std::abs(signedDeg(outOf(v, p.a), -outOf(v, p.b)) - expected);
  const double bend = std::abs(bendA) + std::abs(bendB);
  const double shorter = std::log(std::min(a.count(), b.count())), longer = std::log(std::max(a.count(), b.count()));
  const double freeA = a.isFree[p.a % 2] ? 1.0 : 0.0, freeB = b.isFree[p.b % 2] ? 1.0 : 0.0;
  std::vector<double> f = {t,
                           std::max(0.0, p.turnDeg - kFirstBendDeg) / kEndAngleUnitDeg,
                           std::max(0.0, p.turnDeg - kSecondBendDeg) / kEndAngleUnitDeg,
                           linked * std::min(p.turnDeg, kMostLinkedTurnDeg) / kEndAngleUnitDeg,
                           p.gap > kTouchingEnds ? missDeg(p, v) / kMissUnitDeg : 0.0,
                           gap,
                           p.gap * (1.0 - linked),
                           offset,
                           linked,
                           corner,
                           corner * t,
                           best,
                           advantage(p.bestOther),
                           advantage(p.worseOther),
                           best * linked,
                           unlike / kEndAngleUnitDeg,
                           std::max(0.0, unlike - kUnlikeBendDeg) / kEndAngleUnitDeg,
                           static_cast<double>(std::min(p.arms, kMostArms)),
                           alone,
                           linked * alone,
                           shorter,
                           longer,
                           freeA * freeB,
                           freeA + freeB,
                           std::log(g),
                           bend / kEndAngleUnitDeg,
                           offset - std::log(g + kNoWidth),
                           gap - std::log(g + kNoWidth),
                           p.turnDeg > kBackDeg ? 1.0 : 0.0,
                           t * shorter};
  const std::vector<double> merged = mergeFeatures(a.merged, b.merged, t);
  f.insert(f.end(), merged.begin(), merged.end());
  if (!v.view.isLater) return f;
  const std::vector<double> later = laterEndFeatures(p, v, isBesideToo, gap, offset);
  f.insert(f.end(), later.begin(), later.end());
  return f;
}

}  // namespace batten
