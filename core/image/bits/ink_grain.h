// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Of ink in [specks and holes per stroke width]: a pen leaves up to .06, a dry brush, pencil or charcoal .12 to .35.
constexpr double kTornInk = 0.1;
/// [widths of torn ink, half that of its strokes] More smoothing rounds strokes off.
constexpr double kSmoothingPerWidth = 0.45;

/// How far ink is torn: the grain of a pencil or of charcoal on rough paper.
struct InkGrain {
  double widthPx =
      0.0;  ///< [px] Twice the area by the border: of whole ink the width of its strokes, of torn ink less.
  double perWidth = 0.0;  ///< [-] Specks and holes smaller than a square of that width, per width along the strokes.
};

/// No ink has a width of 0 and no grain.
InkGrain measureGrain(const BitImage& ink, const RunContext& context);

}  // namespace batten
