// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/run_context.h"
#include "core/image/tones/tone_areas.h"

namespace batten {

/// What a page is shaded with: even tones or those of a pencil, whichever leave the least ink that is broader than
/// lines. Where those of a pencil do not, even ones that are full of lines are tried, too.
/// @return Absent: nothing is shaded, or the search was cancelled.
std::optional<ToneAreas> findShading(const ToneCopy&, const RunContext&);

}  // namespace batten
