// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/ruling/rulings.h"

namespace batten {

/// Of the paper's light: what printed rulings take is less.
inline constexpr double kDarkRuling = 0.55;

/// Finds the ruled lines or the grid of the paper, also on a page that is rotated by up to 11 degrees, curled, or seen
/// in perspective so that its lines fan out. Lines count as ruling only if they are thin, at least five, equally spaced
/// over at least half of the page, each seen along most of it and with ink that goes on along it; dark ones must make a
/// grid, fill the page, or lie under the drawing: too even for a hand, thinner than its strokes, and crossed by them.
/// One family of evenly spaced lines across and one down; where two pages lie end to end on the picture, pale lines
/// make one for each. Hatching, railings and grilles of a drawing are shorter, less even or, where they fill the page,
/// so fine that dark lines lie between those of the ruling or run across them; rows of letters have gaps. The margin of
/// ruled paper, one or two straight lines across all of its lines, is a family of one line each. Empty when cancelled.
std::vector<RulingFamily> findRulings(const GreyImage&, const RunContext&);

}  // namespace batten
