// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contour/merge/stroke_mean.h"

namespace batten {

/// The line in the other direction.
void reverseLine(MeanLine& line);
/// The open line from point `from` to point `to`.
MeanLine partOf(const MeanLine& line, int from, int to);
/// A ring begins at another of its points.
void startAt(MeanLine& ring, int first);
/// `more` goes on from the end of `line`; where both cover the same way, `line` gives in, by `mostPx` or a little more.
void appendLine(MeanLine& line, const MeanLine& more, double mostPx);
/// The end of the line goes on at its beginning; what covers the same way twice goes, as in appendLine().
void closeLine(MeanLine& line, double mostPx);
/// Two lines, the ends (2 * line + side) nearest to each place, no farther from it than the distance, meet: where they
/// would if they went on, or halfway.
void meetAtTurns(std::vector<MeanLine>& lines, const std::vector<Vec2>& turns, double distancePx);

/// How a line begins: place and unit direction into the line. Means are bent at their ends, so they are continued from
/// what comes after these.
struct EndTangent {
  Vec2 at = Vec2::Zero(), into = Vec2::Zero();
};
/// The start (side 0) or the end (1) of a line, looked at over about 1.5 distances.
EndTangent endTangent(const MeanLine& line, int side, double distancePx);

/// [deg] 0..180 between two directions.
double turnDeg(const Vec2& a, const Vec2& b);

}  // namespace batten
