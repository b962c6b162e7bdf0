// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/end_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace batten {
namespace {

constexpr double kRowCos = 0.64;  // 50 degrees: from the direction of its row
constexpr int kLeastOfRow = 2;

}  // namespace

bool EndRows::areIn(std::span<const MeetingEnd> ends) {
  int ahead = 0;
  for (const MeetingEnd& end : ends) {
    const double cosine = end.out.dot(ends.front().out);
    if (std::abs(cosine) < kRowCos) return false;
    ahead += cosine > 0.0 ? 1 : 0;
  }
  return ahead >= kLeastOfRow && std::ssize(ends) - ahead >= kLeastOfRow;
}

EndRows::EndRows(std::span<const MeetingEnd> ends) {
  Vec2 along = Vec2::Zero();
  std::array<double, 2> sums = {0.0, 0.0};
  for (const MeetingEnd& end : ends) {
    const bool isAhead = end.out.dot(ends.front().out) > 0.0;
    ends_.push_back({.isAhead = isAhead, .halfPx = end.radius});
    along += isAhead ? end.out : Vec2(-end.out);
    sums[isAhead ? 1 : 0] += end.radius;
  }
  along.normalize();
  for (std::size_t i = 0; i < ends.size(); ++i) ends_[i].acrossPx = cross(along, ends[i].at);
  rowPx_ = std::max(sums[0], sums[1]);
}

bool EndRows::changeSides(const Pair& one, const Pair& other) const {
  const RowEnd &a = ends_[one.first], &b = ends_[one.second];
  const RowEnd *c = &ends_[other.first], *d = &ends_[other.second];
  if (a.isAhead != c->isAhead) std::swap(c, d);
  return (a.acrossPx - c->acrossPx) * (b.acrossPx - d->acrossPx) < 0.0;
}

bool EndRows::isOutermost(int end, double side) const {
  const RowEnd& own = ends_[end];
  return std::ranges::none_of(ends_, [&](const RowEnd& other) {
    return other.isAhead == own.isAhead && side * other.acrossPx > side * own.acrossPx;
  });
}

double EndRows::freePx(int a, int b) const {
  const auto areOutermost = [&](double side) { return isOutermost(a, side) && isOutermost(b, side); };
  const bool isOne = ends_[a].isAhead != ends_[b].isAhead && (areOutermost(1.0) || areOutermost(-1.0));
  return isOne ? std::abs(ends_[a].halfPx - ends_[b].halfPx) : 0.0;
}

bool EndRows::mayCross(const Pair& one, const Pair& other, double narrowestPx) const {
  const auto broader = [&](const Pair& pair) { return std::max(ends_[pair.first].halfPx, ends_[pair.second].halfPx); };
  return mayLieOnAnother(2.0 * narrowestPx, 2.0 * rowPx_, 2.0 * std::min(broader(one), broader(other)));
}

}  // namespace batten
