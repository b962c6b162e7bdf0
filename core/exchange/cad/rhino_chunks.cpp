// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/cad/rhino_chunks.h"

#include <array>

namespace batten::rhino {

std::uint32_t crc32(std::string_view bytes) {
  constexpr std::uint32_t kPolynomial = 0xedb88320;  // of CRC-32, reversed
  static const auto table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value & 1U) != 0 ? kPolynomial ^ (value >> 1) : value >> 1;
      entries[i] = value;
    }
    return entries;
  }();
  std::uint32_t value = ~std::uint32_t{0};
  for (const char c : bytes) value = table[(value ^ static_cast<unsigned char>(c)) & 0xffU] ^ (value >> 8);
  return ~value;
}

}  // namespace batten::rhino
