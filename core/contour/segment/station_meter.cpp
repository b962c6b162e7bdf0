// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/segment/station_meter.h"

#include <algorithm>
#include <cmath>

namespace batten {
namespace {

constexpr double kWindowSpacings = 1.5;     // width of the stretch that a station is fitted to
constexpr double kPixelPointWeight = 0.25;  // points that are only known to the pixel

LocalQuadratic fitWindow(const MeasuredPiece& piece, double s, double window) {
  double from = s - 0.5 * window, to = s + 0.5 * window;
  if (!piece.closed()) {
    // At an end the window keeps its width and becomes one-sided.
    if (from < 0.0) to = std::min(piece.length(), to - from), from = 0.0;
    if (to > piece.length()) from = std::max(0.0, from - (to - piece.length())), to = piece.length();
  }
  int first = piece.lowerBound(from), last = piece.lowerBound(to);
  if (!piece.closed()) last = std::min(last, piece.count() - 1);
  if (piece.closed()) {
    if (last - first + 1 > piece.count()) last = first + piece.count() - 1;
  } else {
    first = std::clamp(first, 0, std::max(0, last - 2));
  }
  std::vector<double> at, weights;
  std::vector<Vec2> points;
  for (int i = first; i <= last; ++i) {
    at.push_back(piece.s(i) - s);
    points.push_back(piece.point(i));
    weights.push_back(piece.weight(i));
  }
  return fitLocalQuadratic(at, points, weights);
}

}  // namespace

MeasuredPiece::MeasuredPiece(const PieceLine& piece) : piece_(piece) {
  const std::vector<Vec2> positions = positionsOf(piece.points);
  s_ = cumulativeLength(positions);
  length_ = polylineLength(positions, piece.closed);
}

double MeasuredPiece::s(int i) const {
  if (!closed()) return s_[i];
  const int n = count();
  const int j = wrapIndex(i, n);
  const int turns = (i - j) / n;
  return s_[j] + length_ * turns;
}

double MeasuredPiece::weight(int i) const { return piece_.points[slot(i)].refined ? 1.0 : kPixelPointWeight; }

int MeasuredPiece::lowerBound(double value) const {
  double rounds = 0.0;
  if (closed() && length_ > 0.0) {
    rounds = std::floor(value / length_);
    value -= rounds * length_;
  }
  const auto it = std::lower_bound(s_.begin(), s_.end(), value);
  return static_cast<int>(it - s_.begin()) + static_cast<int>(rounds) * count();
}

FittedStation makeStation(const MeasuredPiece& piece, double s, double spacing) {
  FittedStation result;
  result.s = s;
  result.fit = fitWindow(piece, s, kWindowSpacings * spacing);
  Station& station = result.station;
  station.point = result.fit.r0;
  if (piece.length() > 0.0) station.along = s / piece.length();
  const double speed = result.fit.r1.norm();
  if (speed > 0.0) station.direction = result.fit.r1 / speed;
  double before = 0.5 * spacing, after = 0.5 * spacing;
  if (!piece.closed()) {
    before = std::min(before, s);
    after = std::min(after, piece.length() - s);
  }
  station.from = station.point - before * station.direction;
  station.to = station.point + after * station.direction;
  return result;
}

}  // namespace batten
