// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/image/bits/bit_image.h"
#include "core/image/threshold/region_thresholds.h"
#include "ui/canvas/scene/tile_pyramid.h"

namespace batten {

/// The pixel layers: what one screen tile is rendered from. Shared and constant, so tiles render on any thread.
struct RasterContent {
  std::shared_ptr<const TilePyramid> pyramid;           ///< Null: no picture of the page.
  std::shared_ptr<const PaperBackground> paper;         ///< Not null: divided out, so that the paper is white.
  std::optional<std::array<std::uint8_t, 256>> tones;   ///< The log image instead of the scan.
  std::shared_ptr<const BitImage> mask, edges, missed;  ///< Null: not shown.
  bool showsPicture = false;
  bool isDark = false;  ///< The theme, for what surrounds the page.
  int maskFactor = 1;   ///< One px of the mask covers so many of the page, along both sides.
  int pageWidth = 0, pageHeight = 0;
  bool operator==(const RasterContent&) const = default;
};

/// The screen pixels `device` (relative to the image's origin at this zoom) as a picture of format RGB32; null where
/// memory does not suffice. Mask and edges are painted by their share of each screen pixel, so thin lines do not drop
/// out.
QImage renderRaster(const RasterContent&, double zoom, const QRect& device);

/// Ink pixels in columns [x0, x1) of a row. @pre 0 <= x0 <= x1 <= width
int inkInRow(const BitImage&, int y, int x0, int x1);

}  // namespace batten
