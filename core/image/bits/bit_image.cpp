// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/bit_image.h"

#include <bit>

#include "core/base/hot_loop.h"

namespace batten {
namespace {

/// Processors that know wider vectors also count bits in one instruction.
BATTEN_HOT_LOOP std::int64_t countAll(const std::uint64_t* words, std::size_t count) {
  std::int64_t ink = 0;
  for (std::size_t i = 0; i < count; ++i) ink += std::popcount(words[i]);
  return ink;
}

}  // namespace

std::int64_t BitImage::count() const { return countAll(words.data(), words.size()); }

}  // namespace batten
