// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/layers/region_grid_layer.h"

#include <QPen>
#include <cmath>

#include "core/base/conventions.h"
#include "ui/canvas/scene/canvas_colors.h"

namespace batten {

void paintRegionGrid(QPainter& painter, const CanvasScene& scene) {
  const QSize size = scene.transform.imageSize();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(colors::grid(), 0));
  for (int k = 0; k <= kRegionsPerSide; ++k) {
    const double x = std::floor(static_cast<double>(size.width()) * k / kRegionsPerSide);
    const double y = std::floor(static_cast<double>(size.height()) * k / kRegionsPerSide);
    painter.drawLine(scene.transform.toWidget({x, 0.0}),
                     scene.transform.toWidget({x, static_cast<double>(size.height())}));
    painter.drawLine(scene.transform.toWidget({0.0, y}),
                     scene.transform.toWidget({static_cast<double>(size.width()), y}));
  }
  painter.restore();
}

}  // namespace batten
