// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/image/scan.h"

namespace batten::test {

/// A large drawing as a good scanner gives it: `strokes` smooth pen strokes of 5 to 12 px over the whole page, paper
/// that falls from 245 to 190 grey across, white noise of 4 grey. The same seed gives the same page. 600 dpi.
Scan largePage(int width, int height, int strokes, std::uint32_t seed);

}  // namespace batten::test
