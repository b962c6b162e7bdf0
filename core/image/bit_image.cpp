// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bit_image.h"

#include <bit>

namespace batten {

std::int64_t BitImage::count() const {
  std::int64_t ink = 0;
  for (const std::uint64_t word : words) ink += std::popcount(word);
  return ink;
}

}  // namespace batten
