// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/grey_image.h"

namespace batten {

/// The edge of a tone laid with an airbrush, or out of focus, changes over more pixels than a profile across it is
/// long. Outlines whose blur was found to be 1.4 px or more are placed once more on copies of the scan of a half, a
/// quarter and an eighth of its size, until the blur is small against the profile there. Where the edge is soft, and is
/// found on the copy, points and sigmaPx follow it, about one point a pixel of the scan as before; sharp stretches of
/// the same outline stay as they are. (An outline of which a fifth or more is sharp shows a small blur and stays
/// whole.) Not complete when cancelled. Same result with any number of threads.
/// @pre refineOutline has run on the outlines.
void refineSoftOutlines(ContourSet&, const GreyImage&, const RunContext&);

}  // namespace batten
