// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "core/construct/construct.h"

namespace batten::test {

using PlaneCurve = std::function<Vec2(double)>;

/// Stations of a parametric curve at equal arc length (measured on 20000 chords), with exact directions.
inline std::vector<Station> stationsOf(const PlaneCurve& curve, double from, double to, int count, bool closed,
                                       const std::function<double(int)>& jitter = {}) {
  constexpr int kSteps = 20000;
  std::vector<double> length = {0.0};
  const auto t = [&](double i) { return from + (to - from) * i / kSteps; };
  for (int i = 1; i <= kSteps; ++i) length.push_back(length.back() + (curve(t(i)) - curve(t(i - 1))).norm());
  std::vector<Station> stations;
  for (int k = 0; k < count; ++k) {
    const double share = (k + (jitter ? jitter(k) : 0.0)) / (closed ? count : count - 1);
    const double s = length.back() * share;
    std::size_t i = 1;
    while (i + 1 < length.size() && length[i] < s) ++i;
    const double f = static_cast<double>(i - 1) + (s - length[i - 1]) / (length[i] - length[i - 1]);
    const double h = 1e-5 * (to - from);
    const Vec2 d = (curve(t(f) + h) - curve(t(f) - h)).normalized();
    stations.push_back({curve(t(f)), d, curve(t(f)) - d, curve(t(f)) + d});
  }
  return stations;
}

inline Vec2 ellipsePoint(double t) { return {300.0 * std::cos(t), 150.0 * std::sin(t)}; }

/// A piece with stations and some points along it.
inline ConstructPiece pieceOf(const PlaneCurve& curve, double from, double to, int count, bool closed) {
  ConstructPiece piece;
  piece.closed = closed;
  piece.stations = stationsOf(curve, from, to, count, closed);
  constexpr int kPoints = 600;
  for (int i = 0; i < kPoints + (closed ? 0 : 1); ++i)
    piece.points.push_back({curve(from + (to - from) * i / kPoints)});
  return piece;
}

}  // namespace batten::test
