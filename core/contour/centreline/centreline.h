// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/contour/centreline/pencil/graininess.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"
#include "core/image/bits/bit_image.h"
#include "core/image/fine_page.h"
#include "core/image/grey_image.h"

namespace batten {

/// What was found along all ink of a page before it was split.
struct StrokesOfInk {
  BitImage ink, skeleton;
  std::vector<StrokePath> paths;
  std::vector<StrokeJunction> junctions;
  GraininessMap grain;
};

/// Centre lines of all strokes of a mask: skeleton for the topology (spurs pruned, smooth stroke paths joined through
/// crossings, gaps bridged, overdrawn strokes merged on request), then the centre from the grey profile across the
/// stroke.
struct CentrelineOptions {
  const BitImage* shapes = nullptr;  ///< Ink beside the strokes, which they may run into: they end at its rim.
  const BitImage* rows = nullptr;    ///< Dashes of broken lines, which stay however short they are.
  double minWidths = 3.0;            ///< ContourParams::minWidths.
  StrokesOfInk* known = nullptr;    ///< By the same parameters: what it holds is not sought again, but taken out of it.
  const BitImage* clear = nullptr;  ///< Paper that no pencil closes, however near its strokes; absent: any.
  /// The page, where mask and grey are enlarged (fine_page.h): the middles are measured on it, whose noise is that of
  /// the scan. Absent: on the grey.
  const GreyImage* page = nullptr;
  /// Of mask and grey, along a pixel of the page.
  int pixelsPerPx() const { return page != nullptr ? kFineFactor : 1; }
};
Result<ContourSet> centrelines(const BitImage& strokes, const GreyImage& grey, const EdgeParams&, const RunContext&,
                               const CentrelineOptions& options = {});

}  // namespace batten
