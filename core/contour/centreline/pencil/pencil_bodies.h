// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/pencil/graininess.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

struct PencilBodyOptions {
  int pixelsPerPx = 1;              ///< More on an enlarged page.
  const BitImage* clear = nullptr;  ///< Paper that stays paper, however near the strokes; absent: what they leave.
};

/// The specks of a pencil become one body each, pen strokes do not grow. Paper that runs on between two lines stays
/// paper, beside pens too: there a threshold closes it as well.
/// @return the strokes as they were when cancelled.
BitImage pencilBodies(const BitImage& strokes, const GreyImage& grey, const std::vector<StrokePath>& paths,
                      const GraininessMap& grain, const PencilBodyOptions& options, const RunContext& context);

}  // namespace batten
