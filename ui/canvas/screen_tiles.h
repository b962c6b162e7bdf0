// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QPainter>
#include <cstdint>
#include <list>
#include <map>
#include <utility>

#include "ui/canvas/layers/raster_layer.h"
#include "ui/canvas/scene/view_transform.h"

namespace batten {

/// The pixel layers as the screen needs them: tiles of 256 device px at the present zoom, the least recently used out
/// first. Panning renders only what comes into view.
class ScreenTiles {
 public:
  static constexpr int kTile = 256;  // [device px] of a side
  /// Renders what is missing (on all cores) and paints the visible tiles. The painter works in device pixels.
  void paint(QPainter&, const ViewTransform&, const RasterContent&);
  std::size_t rendered() const { return rendered_; }  ///< Tiles rendered so far, for tests.

 private:
  using Key = std::pair<int, int>;
  struct Entry {
    QImage image;
    std::uint64_t used = 0;
  };
  std::map<Key, Entry> tiles_;
  RasterContent content_;
  double zoom_ = 0.0;
  std::uint64_t clock_ = 0;
  std::size_t rendered_ = 0;
};

}  // namespace batten
