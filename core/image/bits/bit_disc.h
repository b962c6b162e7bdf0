// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vec2.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Sets the pixels whose centres lie within `radius` px of a place. What lies outside the picture is passed over.
void setDisc(BitImage& image, const Vec2& at, double radius);
/// Whether the centre of a set pixel lies within `radius` px of a place.
bool anyInDisc(const BitImage& image, const Vec2& at, double radius);

}  // namespace batten
