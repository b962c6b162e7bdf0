// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// How far a point of a stroke path may be trusted.
enum class StrokePart : std::uint8_t {
  Ink,       ///< The stroke alone.
  Junction,  ///< Within the ink of another stroke: laid through from both sides.
  Corner,    ///< Where the border of a sharp turn swallowed the middle.
  Bridge,    ///< Laid over a gap in the ink.
};

struct StrokePathPoint {
  Vec2 at = Vec2::Zero();  ///< [px]
  float radius = 0.5f;     ///< [px] half the stroke's width.
  StrokePart part = StrokePart::Ink;
};

/// One pen stroke as the hand went, on skeleton positions.
struct StrokePath {
  std::vector<StrokePathPoint> points;
  bool closed = false;
  std::array<bool, 2> tip = {true,
                             true};  ///< The start, the end is a free end of the ink; else it ends in another stroke.
  double length() const;
  double widthPx() const;  ///< Median; at least 1, and 1 of none.
};

/// [px] A closed one includes the way back to its start.
double strokePathLength(const std::vector<StrokePathPoint>& points, bool closed);

/// [px] Median over all points of the stroke paths chosen by their index; at least 1, and 1 of none.
double medianWidth(const std::vector<StrokePath>& paths, const std::function<bool(int)>& isChosen);

/// [px] Of the end derivatives of a cubic over 0..1 that leaves and arrives in these directions (unit vectors), `chord`
/// px apart: such that it is close to an arc where an arc fits.
double endDerivative(double chord, const Vec2& fromDirection, const Vec2& toDirection);

/// Points about 1 px apart on a cubic that leaves `from` in direction `fromDirection` and arrives at `to` in
/// direction `toDirection` (unit vectors), both ends excluded.
std::vector<Vec2> cubicBetween(const Vec2& from, const Vec2& fromDirection, const Vec2& to, const Vec2& toDirection);

}  // namespace batten
