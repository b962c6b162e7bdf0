// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/grey_image.h"

namespace batten {

/// Whether the lines of a page are brighter than its paper, as chalk on a blackboard or the lines of a blueprint: the
/// page is dark, and what differs clearly from the ground close by is nearly always brighter. A dark exposure has
/// darker lines still, a white sheet on a dark table darker lines on the sheet, and grain differs to both sides. False
/// when cancelled.
bool areLinesBrighter(const GreyImage& page, const RunContext& context);

}  // namespace batten
