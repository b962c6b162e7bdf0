// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace batten {

/// Numbers at places of a file in memory. What lies beyond the end reads as 0: whoever needs it to be there asks has().
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes, bool bigEndian = true) : bytes_(bytes), big_(bigEndian) {}

  std::uint64_t size() const { return bytes_.size(); }
  bool has(std::uint64_t offset, std::uint64_t count) const { return offset <= size() && count <= size() - offset; }
  std::uint32_t u8(std::uint64_t offset) const {
    return has(offset, 1) ? std::to_integer<std::uint32_t>(bytes_[offset]) : 0u;
  }
  std::uint32_t u16(std::uint64_t offset) const { return number(offset, 2); }
  std::uint32_t u24(std::uint64_t offset) const { return number(offset, 3); }
  std::uint32_t u32(std::uint64_t offset) const { return number(offset, 4); }
  bool matches(std::uint64_t offset, std::string_view text) const {
    return has(offset, text.size()) && std::memcmp(bytes_.data() + offset, text.data(), text.size()) == 0;
  }
  ByteReader part(std::uint64_t offset, std::uint64_t count, bool bigEndian) const {
    if (!has(offset, count)) return ByteReader({}, bigEndian);
    return ByteReader(bytes_.subspan(offset, count), bigEndian);
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::uint32_t number(std::uint64_t offset, std::uint32_t count) const {
    std::uint32_t value = 0;
    for (std::uint32_t i = 0; i < count; ++i) value |= u8(offset + i) << (8 * (big_ ? count - 1 - i : i));
    return value;
  }
  std::span<const std::byte> bytes_;
  bool big_;
};

}  // namespace batten
