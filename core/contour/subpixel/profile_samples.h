// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// The kProfileSamples of the profile at `base` along `normal`, by loops over all of them: to the last bit what
/// sampleCubic() or sampleLinear() gives at one place after the other.
void sampleProfile(const GreyImage&, const Vec2& base, const Vec2& normal, bool cubic, float* out);

}  // namespace batten
