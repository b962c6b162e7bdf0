// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace batten {

/// Where a dark line has stopped, as in a box with lettering, ink on its course is not its own: short runs with paper
/// before and behind them. Of a line of dots or dashes all runs are like that, and all are its own.
/// @param inked per pixel along the course, not 0 for ink.
/// @param spacingPx [px] between the lines of the ruling.
/// @return per pixel, not 0 for ink of something else.
std::vector<char> otherInkOnLine(const std::vector<char>& inked, double spacingPx);

}  // namespace batten
