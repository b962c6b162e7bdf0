// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QPainter>
#include <QPoint>
#include <QSize>
#include <optional>

#include "ui/canvas/scene/canvas_scene.h"
#include "ui/canvas/screen_tiles.h"

namespace batten {

/// The pixel layers of a scene as the view shows them now.
RasterContent rasterContent(const CanvasScene&);

/// The lines, and all that is under the overlay, each kept as long as nothing of it changes: moving the mouse costs one
/// blit, and a new mask does not stroke the curves again.
class StillImage {
 public:
  /// Painter in widget coordinates.
  void paint(QPainter&, const CanvasScene&);

 private:
  struct LinesKey {
    QPoint origin;
    QSize size;
    double zoom = 0.0, ratio = 0.0, combScale = 0.0;
    int combDensity = 0, layers = 0;
    std::optional<int> selected;
    bool isGrowing = false, isRadius = false;
    const void *shapes = nullptr, *combs = nullptr, *segments = nullptr, *overlay = nullptr, *contours = nullptr,
               *explanation = nullptr;
    bool operator==(const LinesKey&) const = default;
  };
  struct StillKey {
    RasterContent raster;
    LinesKey lines;
    bool operator==(const StillKey&) const = default;
  };
  static LinesKey linesKeyOf(const CanvasScene&);
  void refresh(const CanvasScene&);
  void refreshLines(const CanvasScene&, const LinesKey&);

  ScreenTiles tiles_;
  QImage lines_, still_;
  LinesKey linesKey_;
  StillKey stillKey_;
};

}  // namespace batten
