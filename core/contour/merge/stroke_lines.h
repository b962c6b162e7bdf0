// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// Reverses the direction of travel.
void reverseLine(MeanLine& line);
/// The open line from point `from` to point `to`.
MeanLine partOf(const MeanLine& line, int from, int to);
/// Makes a closed line start at another of its points.
void startAt(MeanLine& ring, int first);
/// Appends `more` to `line`. Where the two overlap, the end of `line` is cut off, by `mostPx` or slightly more.
void appendLine(MeanLine& line, const MeanLine& more, double mostPx);
/// Closes the line; an overlap of its end with its start is cut off as in appendLine().
void closeLine(MeanLine& line, double mostPx);
/// At each of the places, makes the two nearest line ends within the distance meet: at the intersection of their
/// extensions or, if that is far or ill-conditioned, halfway between them.
void meetAtTurns(std::vector<MeanLine>& lines, const std::vector<Vec2>& turns, double distancePx);

/// Position and direction of a line at its end, the unit direction pointing into the line. Mean lines are distorted at
/// their very ends, so both are extrapolated from further inside.
struct EndTangent {
  Vec2 at = Vec2::Zero(), into = Vec2::Zero();  ///< [px, unit vector]
};
/// The start (side 0) or the end (1) of a line, fitted over about 1.5 distances.
EndTangent endTangent(const MeanLine& line, int side, double distancePx);

}  // namespace batten
