// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/tones/tone_areas.h"

namespace batten {

/// The page with the ground of its tones as bright as paper: lines on them stand out as on paper, as far as their grain
/// allows. Along borders that are sharp and bare runs a line of the width and darkness of the drawn ones, its middle
/// where the page is half way between the tone and what lies beside it.
GreyImage withoutTones(GreyImage, const ToneAreas&, const RunContext&);

}  // namespace batten
