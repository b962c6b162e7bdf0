// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QRect>
#include <QRgb>
#include <QSize>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/scan.h"

namespace batten {

/// One level of a pyramid: 8-bit grey, and colours where the scan has them, in tiles of 256 x 256, each level half the
/// size of the one before.
struct TileLevel {
  static constexpr int kTile = 256;  // px of a side
  int shift = 0;                     ///< One pixel covers 2^shift scan pixels a side.
  int width = 0, height = 0, tilesAcross = 0;
  std::vector<std::uint8_t> tiles;  ///< Tile by tile, row by row within a tile.
  std::vector<Rgb8> colours;        ///< In the same order; empty for a scan without colour.
  std::ptrdiff_t index(int x, int y) const {
    const std::ptrdiff_t tile = std::ptrdiff_t{y >> 8} * tilesAcross + (x >> 8);
    return (tile << 16) + ((y & 255) << 8) + (x & 255);
  }
  std::uint8_t at(int x, int y) const { return tiles[index(x, y)]; }
  const Rgb8& colourAt(int x, int y) const { return colours[index(x, y)]; }
};

/// The scan at halved sizes, for painting at any zoom without touching the whole page. The scan itself is level 0 and
/// is read in place, never copied.
struct TilePyramid {
  std::shared_ptr<const Scan> scan;
  std::vector<TileLevel> levels;  ///< shift 1, 2, …; empty entries are not built yet.
  bool isComplete = false;
  /// The level to paint from: its pixels are about as large as screen pixels at `zoom`; the nearest coarser one while
  /// that is missing; null = the scan itself.
  const TileLevel* levelFor(double zoom) const;
};

/// Only the coarsest level, from sparse samples of the scan: a few milliseconds for any page.
std::shared_ptr<const TilePyramid> coarsePyramid(std::shared_ptr<const Scan>);
/// All levels, box-filtered. Null when cancelled.
std::shared_ptr<const TilePyramid> buildPyramid(std::shared_ptr<const Scan>, const RunContext&);

/// Grey levels of a rectangle of screen pixels (`device` relative to the image's origin at this zoom), bilinear between
/// pixel centres, one per pixel cell above a zoom of 3 so that pixels can be told apart. Outside the page: not written.
/// @param out device.width() * device.height() bytes.
void sampleGrey(const TilePyramid&, double zoom, const QRect& device, std::uint8_t* out);
/// The same for the colours of a scan that has them. @pre !scan->colour.isEmpty()
void sampleColours(const TilePyramid&, double zoom, const QRect& device, QRgb* out);

}  // namespace batten
