// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_paths.h"
#include "core/image/grey_image.h"
#include "core/image/region_surface.h"

namespace batten {

/// How grainy the strokes of a page are, stroke by stroke and region by region. Grain is the mean deviation of the
/// ink's darkness along a stroke that is the pencil's own (what the paper beside it shows as well is taken off), as
/// part of the darkness. Ink: < .03; pencil: > .05.
class GraininessMap {
 public:
  GraininessMap(const std::vector<StrokePath>& paths, const GreyImage& grey, const RunContext& context);

  /// [-] Grain of a stroke path: its own as far as it is long enough to tell, for the rest that of its surroundings.
  double grainOf(int path) const { return grains_[path]; }
  /// Whether a stroke path was drawn with a pencil.
  bool isPencil(int path) const { return grains_[path] > kPencil; }
  /// [-] Mean deviation along the strokes round a place, grain and noise of the scan together, as part of the depth.
  double deviationAt(const Vec2& px) const;
  /// [grey] by which the strokes round a place are darker than their paper.
  double depthAt(const Vec2& px) const;

 private:
  static constexpr double kPencil = 0.045;

  RegionValues ink_{}, paper_{}, depth_{};
  std::vector<double> grains_;
  int width_ = 1, height_ = 1;
};

}  // namespace batten
