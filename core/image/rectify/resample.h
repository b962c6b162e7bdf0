// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"
#include "core/image/rectify/sheet_map.h"

namespace batten {

/// The page of `map` as a picture of widthPx x heightPx, by cubic interpolation (Keys, a = -1/2). Where a pixel of the
/// page covers more than one of the picture the kernel is as much wider, so that no fine line is lost or beats with the
/// grid. Beyond the picture its border goes on.
GreyImage resampled(const GreyImage&, const SheetMap& map, int widthPx, int heightPx, const RunContext&);
/// The same for colours; of an empty picture an empty one.
ColourImage resampled(const ColourImage&, const SheetMap& map, int widthPx, int heightPx, const RunContext&);

}  // namespace batten
