// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Ink of which the holes that its texture left are filled.
struct EvenInk {
  BitImage ink;
  int filled = 0;  ///< Holes.
};

/// Tells the counters of letters and the windows of a silhouette from the holes that a dry brush, chalk or the paper's
/// grain leave in a stroke, and fills the latter. A hole is drawn if it is wide against the shape that it lies in
/// (1/6), if the ink around it is even, if it is far wider than the holes in uneven ink are, or if those are few.
/// @pre ink and grey have the same size. Throws std::bad_alloc. Unfinished when cancelled.
EvenInk fillTextureHoles(BitImage ink, const GreyImage& grey, const RunContext&);

}  // namespace batten
