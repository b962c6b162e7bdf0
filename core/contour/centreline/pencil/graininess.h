// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_surface.h"

namespace batten {

/// [-] Grain above which strokes are a pencil's.
inline constexpr double kPencilGrain = 0.03;

/// Where grain is measured.
enum class GrainPlaces {
  All,    ///< Outside junctions and corners.
  Plain,  ///< And not near them, nor where a stroke turns: of small letters, whose grain these would seem to be.
};

/// How grainy the strokes of a page are, by stroke and by region. Grain is the mean absolute deviation of the darkness
/// along a stroke, less that of the paper beside it, as a part of the darkness; large deviations count as 0.12, so that
/// the ends and crossings of a technical drawing are no grain. Ink: below 0.025; pencil: above 0.035. Short strokes, as
/// those of letters, cannot tell by themselves: beside a pencil they are a pen's where they are as dark as one.
class GraininessMap {
 public:
  GraininessMap(const std::vector<StrokePath>& paths, const GreyImage& grey, const RunContext& context,
                GrainPlaces places = GrainPlaces::All);

  /// [-] Grain of a stroke path. The shorter the path, the more the grain of its surroundings counts.
  double grainOf(int path) const { return grains_[path]; }
  /// Whether a stroke path was drawn with a pencil.
  bool isPencil(int path) const { return grains_[path] > kPencilGrain; }
  /// [-] Mean absolute deviation along the strokes near a place, grain and scanner noise together, as a part of the
  /// depth. Of the pencil's strokes where there is a pen besides.
  double deviationAt(const Vec2& px) const;
  /// [grey] Contrast of the strokes near a place with their paper. Of the pencil's strokes where there is a pen
  /// besides.
  double depthAt(const Vec2& px) const;

 private:
  RegionValues deviation_{}, depth_{};
  std::vector<double> grains_;
  int width_ = 1, height_ = 1;
  friend GraininessMap grainOnFinePage(const std::vector<StrokePath>&, const GreyImage&, const RunContext&);
};

/// Of strokes that were found on a fine page (fine_page.h), as the page itself shows them: an enlargement spreads its
/// grain over more pixels. Places are pixels of the fine page.
GraininessMap grainOnFinePage(const std::vector<StrokePath>& paths, const GreyImage& page, const RunContext& context);

}  // namespace batten
