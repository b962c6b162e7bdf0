// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// What addFaintLines looks at; all of one size.
struct FaintMasks {
  const BitImage& ink;      ///< What is ink anyway, specks removed.
  const BitImage& certain;  ///< The deep part of it.
  const BitImage& faint;    ///< Everything that stands out of the paper; holds the ink.
};

/// Adds to the ink the faint places that are lines: thin, long for their width, and not running along ink that is there
/// already (the soft side of a stroke). A piece that continues ink may be shorter than one that stands alone. Wide
/// faint strokes, shading and texture stay paper; strokes that are ink do not become wider, so that close parallel
/// lines stay apart.
/// @param pixelsPerPx of the masks, along a pixel of the page (fine_page.h).
BitImage addFaintLines(const FaintMasks& masks, const RunContext& context, int pixelsPerPx = 1);

}  // namespace batten
