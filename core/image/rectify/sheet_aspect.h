// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/image/rectification.h"

namespace batten {

/// The camera, as far as it is known.
struct PictureView {
  int widthPx = 0, heightPx = 0;    ///< Of the picture; its optical axis is taken to meet its middle.
  std::optional<double> focal35Mm;  ///< [mm] On film of 36 mm x 24 mm, if the file states it.
};

struct SheetAspect {
  double aspect = 1.0;  ///< Width over height.
  double error = 0.0;   ///< Standard error as a share of it.
};

/// The aspect ratio of a rectangle from the perspective in which it is seen (Zhang and He, Whiteboard scanning and
/// image enhancement, 2007): its sides are at right angles for one focal length only. Where these say little (seen from
/// the front, or tilted about one side only), the file's focal length counts, or that of a usual camera.
SheetAspect sheetAspect(const SheetCorners&, const PictureView&);

}  // namespace batten
