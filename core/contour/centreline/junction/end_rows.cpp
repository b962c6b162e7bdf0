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
    isAhead_.push_back(isAhead);
    halfPx_.push_back(end.radius);
    along += isAhead ? end.out : Vec2(-end.out);
    sums[isAhead ? 1 : 0] += end.radius;
  }
  along.normalize();
  for (const MeetingEnd& end : ends) acrossPx_.push_back(cross(along, end.at));
  rowPx_ = std::max(sums[0], sums[1]);
}

bool EndRows::changeSides(const Pair& one, const Pair& other) const {
  const auto [a, b] = one;
  auto [c, d] = other;
  if (isAhead_[a] != isAhead_[c]) std::swap(c, d);
  return (acrossPx_[a] - acrossPx_[c]) * (acrossPx_[b] - acrossPx_[d]) < 0.0;
}

bool EndRows::isOutermost(int end, double side) const {
  for (std::size_t i = 0; i < acrossPx_.size(); ++i)
    if (isAhead_[i] == isAhead_[end] && side * acrossPx_[i] > side * acrossPx_[end]) return false;
  return true;
}

double EndRows::freePx(int a, int b) const {
  const auto areOutermost = [&](double side) { return isOutermost(a, side) && isOutermost(b, side); };
  const bool isOne = isAhead_[a] != isAhead_[b] && (areOutermost(1.0) || areOutermost(-1.0));
  return isOne ? std::abs(halfPx_[a] - halfPx_[b]) : 0.0;
}

bool EndRows::mayCross(const Pair& one, const Pair& other, double narrowestPx) const {
  const auto broader = [&](const Pair& pair) { return std::max(halfPx_[pair.first], halfPx_[pair.second]); };
  return mayLieOnAnother(2.0 * narrowestPx, 2.0 * rowPx_, 2.0 * std::min(broader(one), broader(other)));
}

}  // namespace batten
