// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// Places soft edges (airbrush, out of focus), which are wider than the profile across them. Outlines with a blur
/// of 1.4 px or more are placed again on copies of the scan at a half, a quarter and an eighth of its size, until the
/// blur is small against the profile. Where the edge is soft and is found on the copy, position and sigmaPx come from
/// there; sharp stretches of the same outline stay. (An outline of which a fifth or more is sharp shows a small blur
/// and is left alone.) Not complete when cancelled. Same result with any number of threads.
/// @pre refineOutline has run on the outlines.
void refineSoftOutlines(ContourSet&, const GreyImage&, const RunContext&);

}  // namespace batten
