// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/angle.h"

namespace batten {
namespace {

constexpr double kLooksLikeCornerRad = 25.0 * kRadPerDeg;  // a gentler turn is a bend: no mark snaps to it
constexpr double kTurnInnerPx = 3.0;                       // the part next to a corner that blur has rounded
constexpr double kTurnOuterPx = 16.0;                      // about as far as a corner of a drawing stands free
constexpr double kSnapOuterPx = 64.0;                      // looked at on either side before the neighbours are known
constexpr double kOneTurnPx = 5.0;         // the first of equally sharp points within this stands for the turn
constexpr double kFartherWorsePart = 0.5;  // of its score: what a turn at the snap distance loses

}  // namespace

CornerFinder::CornerFinder(const ContourSet& set, double snapDistancePx)
    : set_(set), snap_(snapDistancePx), reach_(snapDistancePx + kFarthestTipPx) {}

void CornerFinder::sortPoints() {
  grid_.emplace(reach_);
  low_.fill(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (int c = 0; c < std::ssize(set_.contours); ++c) {
    for (int i = 0; i < std::ssize(set_.contours[c].points); ++i) {
      const Vec2& point = at({c, i});
      grid_->add(point, {c, i});
      low_ = low_.cwiseMin(point);
      high_ = high_.cwiseMax(point);
    }
  }
}

// In the order of the lines.
std::vector<ContourPlace> CornerFinder::placesNear(const Vec2& mark) const {
  std::vector<ContourPlace> near;
  const auto look = [&](const ContourPlace& p) {
    if ((at(p) - mark).squaredNorm() <= reach_ * reach_) near.push_back(p);
  };
  if (grid_) {
    // A mark may be any distance away, farther than cells are numbered.
    if ((mark - low_).minCoeff() < -reach_ || (high_ - mark).minCoeff() < -reach_) return near;
    grid_->around(mark, look);
    std::sort(near.begin(), near.end());
    return near;
  }
  for (int c = 0; c < std::ssize(set_.contours); ++c)
    for (int i = 0; i < std::ssize(set_.contours[c].points); ++i) look({c, i});
  return near;
}

std::optional<CornerFinder::Snapped> CornerFinder::nearest(const std::vector<ContourPlace>& near,
                                                           const Vec2& mark) const {
  std::optional<ContourPlace> best;
  double least = snap_ * snap_;
  for (const ContourPlace& p : near) {
    const Contour& contour = contourOf(p);
    // The sharp point of a pen stroke is one of the points that were drawn (004 section 3.2), none in between.
    if (isDrawn(contour.kind) && !contour.points[p.index].refined) continue;
    const double d = (at(p) - mark).squaredNorm();
    if (d > least || (best && d == least)) continue;
    best = p;
    least = d;
  }
  if (!best) return std::nullopt;
  return Snapped{*best, std::sqrt(least)};
}

std::optional<double> CornerFinder::turnScore(const ContourPlace& p) {
  const auto [known, isNew] = scores_.try_emplace(p);
  if (!isNew) return known->second;
  const Contour& contour = contourOf(p);
  const double inner = contour.kind == ContourKind::Outline ? kTurnInnerPx : roundedZonePx(contour, p.index);
  const auto turning = turningAt(contour, p.index, inner, kTurnOuterPx + 2.0 * (inner - kTurnInnerPx));
  if (turning && std::abs(turning->angleRad) >= kLooksLikeCornerRad) known->second = turning->score;
  return known->second;
}

const CornerFix& CornerFinder::fixAt(const ContourPlace& p) {
  const auto [known, isNew] = fixes_.try_emplace(p);
  if (isNew) {
    const Contour& contour = contourOf(p);
    known->second = locateCorner(contour, p.index, roundedZonePx(contour, p.index), kSnapOuterPx, kSnapOuterPx);
  }
  return known->second;
}

// Of the turns of one stretch of a line.
std::optional<CornerFinder::Snapped> CornerFinder::sharpestTurn(std::vector<ScoredPlace> turns, const Vec2& mark) {
  std::stable_sort(turns.begin(), turns.end(),
                   [](const ScoredPlace& a, const ScoredPlace& b) { return a.score > b.score; });
  std::optional<Snapped> best;
  std::vector<Vec2> taken;
  for (const ScoredPlace& turn : turns) {
    const Vec2& here = at(turn.place);
    if (std::any_of(taken.begin(), taken.end(), [&](const Vec2& t) { return (t - here).norm() < kOneTurnPx; })) {
      continue;
    }
    taken.push_back(here);
    const double distance = (fixAt(turn.place).position - mark).norm();
    const double score = turn.score * (1.0 - kFartherWorsePart * distance / snap_);
    if (distance <= snap_ && score > scoreOf(best)) best = Snapped{turn.place, distance, score};
  }
  return best;
}

// A click need not be exact: a sharp turn within the snap distance wins over the nearest point, the nearer and sharper
// one first. The turn is where its two sides meet when extended, because the filter of the mask ends a contour 10 px
// and more before an acute tip.
std::optional<CornerFinder::Snapped> CornerFinder::sharpest(const std::vector<ContourPlace>& near, const Vec2& mark) {
  std::optional<Snapped> best;
  if (!(snap_ > 0.0)) return best;
  for (auto first = near.begin(); first != near.end();) {
    // A stretch of one line.
    auto end = first + 1;
    while (end != near.end() && end->contour == first->contour && end->index == (end - 1)->index + 1) ++end;
    std::vector<ScoredPlace> turns;
    if (!isDrawn(contourOf(*first).kind)) {
      for (auto p = first; p != end; ++p)
        if (const auto score = turnScore(*p)) turns.push_back({*p, *score});
    }
    const auto snapped = sharpestTurn(std::move(turns), mark);
    if (snapped && scoreOf(snapped) > scoreOf(best)) best = snapped;
    first = end;
  }
  return best;
}

std::optional<Corner> CornerFinder::find(const Vec2& mark) {
  if (!mark.allFinite() || !(snap_ >= 0.0)) return std::nullopt;
  const std::vector<ContourPlace> near = placesNear(mark);
  std::optional<Snapped> best = sharpest(near, mark);
  const std::optional<Snapped> point = nearest(near, mark);
  const bool isOnDrawn = point && isDrawn(contourOf(point->place).kind);
  // A drawn point means itself: it need not be the sharpest place around.
  if (!best || (isOnDrawn && point->distance < best->distance)) best = point;
  if (!best) return std::nullopt;
  Corner corner;
  corner.contour = best->place.contour;
  corner.pointIndex = best->place.index;
  corner.snapPx = best->distance;
  corner.positionPx = at(best->place);
  if (const auto turning = turningAt(contourOf(best->place), best->place.index, kTurnInnerPx, kTurnOuterPx)) {
    corner.turningAngleRad = turning->angleRad;
  }
  return corner;
}

}  // namespace batten
