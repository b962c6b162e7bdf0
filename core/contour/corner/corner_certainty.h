// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/angle.h"
#include "core/base/vec2.h"
#include "core/contour/contour_set.h"
#include "core/contour/corner/corner_geometry.h"

namespace batten {

/// A corner candidate on a line, with its measurements.
struct CornerEvidence {
  int pointIndex = 0;                        ///< Of the line's points.
  double angleRad = 0.0;                     ///< Change of direction, signed as Turning.
  Vec2 positionPx = Vec2::Zero();            ///< Where its two sides meet, or the point itself.
  bool isLocated = false;                    ///< The sides meet.
  double roughPx = 0.0;                      ///< [px] rms of the line about smooth stretches of it.
  double angleNoiseRad = 0.0;                ///< [rad] standard deviation that this gives to the angle.
  double freeBefore = 0.0, freeAfter = 0.0;  ///< [px of arc] To the neighbouring places or the open ends.
  std::optional<double> angleBefore = {}, angleAfter = {};  ///< [rad] Of those places; absent: an open end.
};

/// How certain it is that such places are corners and neither bends nor dents: 0..1, from kCertainCorner on taken for
/// granted. The unit of length is what rounds the line by itself: the width of the stroke, the blur of a border, or a
/// multiple of the roughness. A corner is sharp at that scale: its vertex lies no farther from the line than that of a
/// rounding of radius r, r (sec(angle / 2) - 1), r being 1.5 units; or, where the tip of a shape was filtered away, no
/// larger rounding has room between what was seen of its sides. The vertex lies within 2.3 units of the line, that of
/// an acute tip as far as the shape is too narrow for its ink to be seen, and within 12 px. The corner has sides of 2.5
/// units and more, and they bend far less than it turns: chords over 3 and 6 units agree. Where the line turns back
/// again within 8 units it may be a dent, unless it turns by 70 degrees; the middle of a pen's stroke has none, but may
/// be a wave: there 40 degrees are enough, of sides that do not go on turning. Of its sides 1.5 units must be free of
/// the ink of their corners.
class CornerJudge {
 public:
  explicit CornerJudge(const Contour&);
  double certainty(const CornerEvidence&) const;

 private:
  double unitAt(const CornerEvidence&) const;
  double unseenRadius(const CornerEvidence&, int tip) const;
  double turnOfSides(const CornerEvidence&, double arc, double unit) const;
  Vec2 atArc(double) const;
  double chordTurn(double arc, double near, double before, double after) const;

  const Contour& contour_;
  std::vector<double> arc_;
  double length_ = 0.0;
  double typicalWidthPx_ = 0.0;
};

/// Minimum certainty for automatic corners.
inline constexpr double kCertainCorner = 0.95;
/// [px] The unit is no less: blur and mask round a border by about as much.
inline constexpr double kLeastUnitPx = 3.0;
/// [rad] The least turn of a corner of a pen's stroke, whose middle has no dents.
inline constexpr double kLeastPennedTurn = 40.0 * kRadPerDeg;

}  // namespace batten
