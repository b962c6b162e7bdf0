// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// What thresholds (`automatic`, after `smoothingPx`) make of a page.
struct GreyParts {
  std::int64_t pieces = 0;  ///< Of ink and of paper, without single pixels of noise.
  /// The bright part are the meshes of a net: pieces about as long as wide. Bright lines and letters are longer.
  bool hasMeshes = false;
};
GreyParts greyPartsOf(const GreyImage&, const RegionThresholds&, const RunContext&);

}  // namespace batten
