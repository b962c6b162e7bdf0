// SPDX-License-Identifier: GPL-3.0-or-later
// Lines drawn in several strokes, rendered, so that it is known which lines were intended.
#pragma once

#include <functional>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/contour_set.h"
#include "core/image/scan.h"

namespace batten::test {

using IntendedLine = std::function<Vec2(double)>;  ///< 0..1

inline constexpr double kOverdrawnPenPx = 4.0, kOverdrawnInkPx = 3.6;  ///< On paper, and as measured.
inline constexpr int kOverdrawnPagePx = 640;                           ///< Width and height.

IntendedLine straightLine(const Vec2& a, const Vec2& b);
IntendedLine cubicLine(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);
/// A closed bean in the middle of the page.
Vec2 beanAt(double t);

using PenPath = std::vector<Vec2>;
/// One stroke along a line: from part `from` to part `to`, wavering about an offset to the side. [px]
PenPath strokeAlong(const IntendedLine& line, double from, double to, double offset, double waver, double phase);
/// One stroke that wanders beside a line as a hand does: by about `scatterPx` (standard deviation).
PenPath wanderAlong(const IntendedLine& line, double from, double to, double scatterPx, unsigned seed);
/// A line in `count` strokes that each run over all of it, but for what they leave out or overshoot at the ends.
void drawOver(std::vector<PenPath>& strokes, const IntendedLine& line, int count, double spreadPx, unsigned seed);
/// A page with these strokes.
Scan overdrawnScan(const std::vector<PenPath>& strokes);
/// Its lines, merged so many stroke widths, and the report of the trace.
ContourSet traceOverdrawn(const std::vector<PenPath>& strokes, double mergeWidths);
/// Merged where their middles are no farther apart than the distance.
std::vector<Contour> mergedLines(const std::vector<PenPath>& strokes, double distancePx);

}  // namespace batten::test
