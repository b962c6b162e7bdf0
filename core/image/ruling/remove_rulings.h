// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/ruling/rulings.h"

namespace batten {

/// The page without its ruled lines: what a line takes of the paper's light is given back, so that strokes across it
/// keep their ink. A line that is darker here and lighter there goes with its darker places. Where a line is as dark as
/// the strokes, ink stays where it goes on at both sides of the line.
/// @return an empty picture when cancelled.
GreyImage withoutRulings(const GreyImage&, const std::vector<RulingFamily>&, const RunContext&);

}  // namespace batten
