// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/tones/tone_areas.h"

namespace batten {

/// Finds areas that a pencil or charcoal has shaded, and the lines drawn on and around them: what means along lines
/// show to be darker than both sides, more than the grain of the tone explains. Such a tone is the paper of its lines:
/// what is no line in it becomes paper, and the lines are made as dark as lines on paper are. Areas as dark as the
/// lines beside them that end sharply are solids and stay ink, and so do areas that hardly a line is drawn on and
/// around, those without grain, and whatever is narrower than a few lines.
/// @return with ToneAreas::KnownGain, which says by how much. Absent: there are none, or the search was cancelled.
std::optional<ToneAreas> findPencilTones(const ToneCopy&, const RunContext&);

}  // namespace batten
