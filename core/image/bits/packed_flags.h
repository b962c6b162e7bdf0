// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace batten {

/// Flags of 0 or 1 as the bits of words, the first in the lowest bit; those beyond the last flag are 0.
inline void packFlags(const std::uint8_t* flags, int count, std::uint64_t* out) {
  // Eight flags of a byte each become eight bits by one multiplication, whatever the order of the bytes.
  const auto eightFrom = [flags](int x) {
    std::uint64_t eight = 0;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(&eight, flags + x, 8);
    } else {
      for (int k = 0; k < 8; ++k) eight |= std::uint64_t{flags[x + k]} << (8 * k);
    }
    return (eight * 0x0102040810204080ull) >> 56;
  };
  for (int x = 0; x < count; x += 64) {
    const int here = count - x < 64 ? count - x : 64;
    std::uint64_t word = 0;
    int k = 0;
    for (; k + 8 <= here; k += 8) word |= eightFrom(x + k) << k;
    for (; k < here; ++k) word |= std::uint64_t{flags[x + k]} << k;
    out[x / 64] = word;
  }
}

}  // namespace batten
