// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_certainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/angle.h"
#include "core/base/statistics.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kRoughUnits = 6.0;         // of the roughness
constexpr double kWidthLimit = 1.5;         // of the usual width: at a junction the ink is wider than the stroke
constexpr double kSharpRadius = 1.5;        // units
constexpr double kSharpSketchRadius = 2.0;  // of lines of a pencil or merged from several: a sketching hand turns
constexpr double kSharpSlackPx = 0.4;       // a vertex is known to that
constexpr double kFarthestVertex = 2.3;     // units from the line, even for acute tips
// Where a tip of a shape is narrower than the first, blur leaves nothing of it; so far from the line at most.
constexpr double kLostWidthPx = 2.4, kFarthestLostPx = 12.0;
constexpr double kPointsPerPx = 4.0;  // [1/px] more than any contour has: neighbours lie 0.35 px apart or more
constexpr double kPointStepPx = 1.0;  // located points lie as far apart: a rounding may begin behind one
constexpr double kShortChord = 3.0, kCertainChord = 6.0, kChordStart = 1.0;  // units
constexpr double kLeastSide = 2.5, kLeastSideToEnd = 3.0;                    // units: ends have hooks of their own
constexpr double kLeastCertainTurn = 30.0 * kRadPerDeg;                      // a gentler one may be a bend of the line
constexpr double kLeastUnlocatedTurn = 50.0 * kRadPerDeg;  // of the chords, where no vertex tells how sharp it is
constexpr double kFlankShare = 0.25;                       // of the turn: how much more the longer chords may turn
constexpr double kUnlocatedShare = 0.15;                   // the same where no vertex tells
constexpr double kLeastChordShare = 0.5, kMostChordShare = 1.35;  // of the angle: cusps, arcs
constexpr double kFaintTurn = 45.0 * kRadPerDeg;                  // below, both chords must show the angle itself
constexpr double kFaintShare = 0.15, kFaintLongShare = 0.2;       // of the angle: by which the two chords may miss it,
constexpr double kFaintSlackRad = 2.0 * kRadPerDeg;               // and by so much more
constexpr double kNoiseLimit = 3.5;                               // standard deviations
constexpr double kDentReach = 8.0;                                // units
constexpr double kDentShare = 0.5;                                // of the turn that turns back
constexpr double kLeastDivisor = 1e-9;                   // keeps shares finite where there is no side or no turn
constexpr double kNoDentTurn = 70.0 * kRadPerDeg;        // beside a turn back a gentler one may be a side of a dent
constexpr double kMostBlendedTurn = 170.0 * kRadPerDeg;  // of a sharper one the ink tells no length
constexpr double kBentShare = 0.1;                       // of the turn: by so much the sides of such go on to turn,
constexpr double kBentSlackRad = 2.0 * kRadPerDeg;       // and so much more
constexpr double kBlurUnits = 0.35;                      // beyond what the other side's ink bends, blur does
constexpr double kLeastSeenSide = 1.5;                   // units of a stroke's side that its corners leave free
constexpr double kSteepness = 4.0, kOddsAtLimit = 19.0;  // 19 to 1 where the worst share is just 1

// [px] What is seen of a stroke's side between two corners, or a corner and an end: where two sides come together the
// ink has one middle until they are the width of the stroke apart.
double seenSide(double free, double turn, const std::optional<double>& next, double width) {
  const auto blended = [&](double angle) { return 0.5 * width * std::tan(0.5 * std::min(angle, kMostBlendedTurn)); };
  return free - blended(turn) - (next ? blended(std::abs(*next)) : 0.5 * width);
}

/// [px] How far the vertex may lie from the line. @param angle by which the line is seen to turn
double farthestVertex(const Contour& contour, double angle, double unit) {
  if (contour.kind != ContourKind::Outline) return kFarthestVertex * unit;
  const double lost = 0.5 * kLostWidthPx * std::tan(0.5 * angle);  // the sides open by pi - angle
  return std::max(kFarthestVertex * unit, std::min(lost, kFarthestLostPx));
}

}  // namespace

CornerJudge::CornerJudge(const Contour& contour)
    : contour_(contour), arc_(cumulativeLength(positionsOf(contour.points))) {
  length_ = polylineLength(positionsOf(contour.points), contour.closed);
  const std::vector<float> widths = strokeWidthsOf(contour.points);
  if (!widths.empty()) typicalWidthPx_ = upperMedian(std::vector<double>(widths.begin(), widths.end()));
}

double CornerJudge::unitAt(const CornerEvidence& e) const {
  const ContourPoint& p = contour_.points[e.pointIndex];
  double unit = std::max(kLeastUnitPx, kRoughUnits * e.roughPx);
  if (p.widthPx) unit = std::max(unit, std::min<double>(*p.widthPx, kWidthLimit * typicalWidthPx_));
  if (p.bundle) unit = std::max<double>(unit, p.bundle->left + p.bundle->right);
  return unit;
}

Vec2 CornerJudge::atArc(double s) const {
  if (contour_.closed) s -= length_ * std::floor(s / length_);
  s = std::clamp(s, 0.0, length_);
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), s);
  const auto i = std::max<std::ptrdiff_t>(0, after - arc_.begin() - 1);
  const std::ptrdiff_t next = i + 1 < std::ssize(arc_) ? i + 1 : contour_.closed ? 0 : i;
  const double end = next > i ? arc_[next] : length_;
  const double f = end > arc_[i] ? (s - arc_[i]) / (end - arc_[i]) : 0.0;
  return contour_.points[i].at + f * (contour_.points[next].at - contour_.points[i].at);
}

// Between the chords from `before` to `near` ahead of a place and from `near` to `after` behind it; signed as Turning.
double CornerJudge::chordTurn(double arc, double near, double before, double after) const {
  const Vec2 in = atArc(arc - near) - atArc(arc - before), out = atArc(arc + after) - atArc(arc + near);
  return -std::atan2(cross(in, out), in.dot(out));
}

// [rad] By which the sides go on turning the same way beyond the corner, each as far as the middle of its leg: those of
// a wave do.
double CornerJudge::turnOfSides(const CornerEvidence& e, double arc, double unit) const {
  const double from = (0.5 * std::tan(0.5 * std::min(std::abs(e.angleRad), kMostBlendedTurn)) + kBlurUnits) * unit;
  double turned = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const double to = std::min(0.5 * (side < 0.0 ? e.freeBefore : e.freeAfter), kShortChord * unit);
    const Vec2 a = atArc(arc + side * from), b = atArc(arc + 0.5 * side * (from + to)), c = atArc(arc + side * to);
    const Vec2 first = side * (b - a), then = side * (c - b);
    if (to > from) turned -= side * std::copysign(1.0, e.angleRad) * std::atan2(cross(first, then), first.dot(then));
  }
  return turned;
}

// Of the largest rounding that fits between the located points on either side of a tip; infinite where there are none.
double CornerJudge::unseenRadius(const CornerEvidence& e, int tip) const {
  const int n = static_cast<int>(contour_.points.size());
  double tangent = 0.0;
  for (const int side : {-1, 1}) {
    int i = tip;
    for (int k = 0; k < n && !contour_.points[i].refined; ++k)
      i = contour_.closed ? wrapIndex(i + side, n) : std::clamp(i + side, 0, n - 1);
    if (!contour_.points[i].refined) return std::numeric_limits<double>::infinity();
    tangent = std::max(tangent, (contour_.points[i].at - e.positionPx).norm());
  }
  return (tangent - kPointStepPx) / std::tan(0.5 * std::abs(e.angleRad));
}

double CornerJudge::certainty(const CornerEvidence& e) const {
  const double unit = unitAt(e), angle = std::abs(e.angleRad);
  if (!(angle > 0.0)) return 0.0;
  const ContourPoint& turned = contour_.points[e.pointIndex];
  const bool isStroke = contour_.kind == ContourKind::Centreline && turned.widthPx;
  const bool isSketched = isStroke && !turned.sigmaPx, isPenned = isStroke && turned.sigmaPx;
  NearestPoint tip{e.pointIndex, 0.0};
  if (e.isLocated)
    tip = nearestAlong(contour_, e.pointIndex, e.positionPx, static_cast<int>(kPointsPerPx * kFarthestVertex * unit));
  // Where the tip of a shape was filtered away the place that turns most may lie beside it.
  const bool isTipLost = contour_.kind == ContourKind::Outline && !contour_.points[tip.index].refined;
  const double arc = arc_[isTipLost ? tip.index : e.pointIndex];
  const bool toEnd = !contour_.closed && std::min(arc, length_ - arc) <= std::min(e.freeBefore, e.freeAfter);
  double worst =
      (toEnd ? kLeastSideToEnd : kLeastSide) * unit / std::max(kLeastDivisor, std::min(e.freeBefore, e.freeAfter));
  const auto demand = [&worst](double value, double limit) { worst = std::max(worst, value / limit); };
  const auto turnOver = [&](double units) {
    const double most = units * unit;
    const double turn = chordTurn(arc, kChordStart * unit, std::min(most, e.freeBefore), std::min(most, e.freeAfter));
    return std::max(kLeastDivisor, std::copysign(1.0, e.angleRad) * turn);
  };
  const double near = turnOver(kShortChord), far = turnOver(kCertainChord);
  demand(kLeastCertainTurn, angle);
  demand(kNoiseLimit * e.angleNoiseRad, angle);
  demand(kLeastChordShare * angle, near);
  demand(near, kMostChordShare * angle);
  demand(far - near, kFlankShare * near);
  const auto turnsBack = [&](double free, const std::optional<double>& other) {
    return other && free < kDentReach * unit && *other * e.angleRad < 0.0 && std::abs(*other) >= kDentShare * angle;
  };
  if (turnsBack(e.freeBefore, e.angleBefore) || turnsBack(e.freeAfter, e.angleAfter)) {
    demand(isPenned ? kLeastPennedTurn : kNoDentTurn, angle);
    if (isPenned) demand(turnOfSides(e, arc, unit), kBentShare * angle + kBentSlackRad);
  }
  if (isPenned)
    demand(kLeastSeenSide * unit, std::max(kLeastDivisor, std::min(seenSide(e.freeBefore, angle, e.angleBefore, unit),
                                                                   seenSide(e.freeAfter, angle, e.angleAfter, unit))));
  if (e.isLocated) {
    const double sharp = isSketched ? kSharpSketchRadius : kSharpRadius;
    double rounded = tip.distance / (sharp * unit * (1.0 / std::cos(0.5 * angle) - 1.0) + kSharpSlackPx);
    // The guesses that stand for a lost tip say less than how far the sides were seen to go.
    if (isTipLost) rounded = std::min(rounded, unseenRadius(e, tip.index) / (sharp * unit));
    demand(rounded, 1.0);
    demand(tip.distance, farthestVertex(contour_, std::min({angle, near, far}), unit));
  } else {
    demand(kLeastUnlocatedTurn, near);
    demand(std::abs(far - near), kUnlocatedShare * near);
  }
  if (angle < kFaintTurn) {
    demand(std::abs(near - angle), kFaintShare * angle + kFaintSlackRad);
    demand(std::abs(far - angle), kFaintLongShare * angle + kFaintSlackRad);
  }
  for (const auto& [first, last] : contour_.bridges) {
    if (arc >= arc_[std::clamp<int>(first, 0, static_cast<int>(arc_.size()) - 1)] - unit &&
        arc <= arc_[std::clamp<int>(last, 0, static_cast<int>(arc_.size()) - 1)] + unit)
      return 0.0;
  }
  return kOddsAtLimit / (kOddsAtLimit + std::pow(worst, kSteepness));
}

}  // namespace batten
