// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/plane.h"
#include "core/image/threshold/region_surface.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// What thresholds (`automatic`, after `smoothingPx`) make of a page.
struct GreyParts {
  std::int64_t pieces = 0;  ///< Of ink and of paper, without single pixels of noise.
  /// The bright part are the meshes of a net: pieces about as long as wide. Bright lines and letters are longer.
  bool hasMeshes = false;
};
GreyParts greyPartsOf(const GreyImage&, const RegionThresholds&, const RunContext&);

/// Whether the grey of most regions varies by more than lines of the contrast that was found there: paper and ink
/// differ from their mean by half of it at most. Then what was taken for paper is a mean over lines and the gaps
/// between them, as of hatching that meets the cells in step. @param halfLevels [grey] of lines, below the paper.
bool variesMoreThanLines(const Plane& grey, const RegionValues& halfLevels);

}  // namespace batten
