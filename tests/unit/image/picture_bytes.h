// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// \file
/// Small pictures byte by byte, as their formats define them.

namespace batten::test {

inline std::string little(std::uint32_t value, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text.push_back(static_cast<char>(value >> (8 * i) & 0xffu));
  return text;
}
inline std::string big(std::uint32_t value) {
  const std::string text = little(value, 4);
  return {text.rbegin(), text.rend()};
}

inline std::uint32_t crc(const std::string& bytes) {
  std::uint32_t value = 0xffffffffu;
  for (const char c : bytes) {
    value ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) value = (value & 1u) != 0 ? 0xedb88320u ^ (value >> 1) : value >> 1;
  }
  return ~value;
}
inline std::string chunk(const std::string& name, const std::string& data) {
  return big(static_cast<std::uint32_t>(data.size())) + name + data + big(crc(name + data));
}
/// Zlib stream of stored blocks.
inline std::string stored(const std::string& data) {
  std::uint32_t a = 1, b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint32_t>(data.size());
  return std::string("\x78\x01\x01", 3) + little(size, 2) + little(~size & 0xffffu, 2) + data + big(b << 16 | a);
}
/// @param rows every row with its filter byte in front.
inline std::string png(std::uint32_t width, std::uint32_t height, int bits, int colour, const std::string& rows,
                       const std::string& extra = {}) {
  const std::string header =
      big(width) + big(height) + static_cast<char>(bits) + static_cast<char>(colour) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + extra + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

/// 3 x 2 grey TIFF with the values 10 20 30 / 40 50 60.
inline std::string tiff(std::uint32_t orientation) {
  const auto entry = [](std::uint32_t tag, std::uint32_t type, std::uint32_t count, std::uint32_t value) {
    return little(tag, 2) + little(type, 2) + little(count, 4) + little(value, 4);
  };
  const std::uint32_t data = 8 + 2 + 13 * 12 + 4;
  return "II" + little(42, 2) + little(8, 4) + little(13, 2) + entry(256, 3, 1, 3) + entry(257, 3, 1, 2) +
         entry(258, 3, 1, 8) + entry(259, 3, 1, 1) + entry(262, 3, 1, 1) + entry(273, 4, 1, data + 16) +
         entry(274, 3, 1, orientation) + entry(277, 3, 1, 1) + entry(278, 3, 1, 2) + entry(279, 4, 1, 6) +
         entry(282, 5, 1, data) + entry(283, 5, 1, data + 8) + entry(296, 3, 1, 2) + little(0, 4) + little(300, 4) +
         little(1, 4) + little(300, 4) + little(1, 4) + "\x0a\x14\x1e\x28\x32\x3c";
}

inline std::string fromHex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

/// `extra`: the meaning of the last sample (1 associated, 2 other alpha; 0 none).
struct TiffPixels {
  std::uint32_t bits, photometric, samples, extra;
};

/// TIFF of one strip, without compression.
inline std::string tiffOf(std::uint32_t width, std::uint32_t height, const TiffPixels& pixels,
                          const std::string& data) {
  const auto& [bits, photometric, samples, extra] = pixels;
  std::vector<std::string> entries;
  const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t count, std::uint32_t value) {
    entries.push_back(little(tag, 2) + little(type, 2) + little(count, 4) + little(value, 4));
  };
  const std::uint32_t count = extra > 0 ? 12 : 11;
  const std::uint32_t depths = 8 + 2 + count * 12 + 4, start = depths + 8;
  entry(256, 3, 1, width);
  entry(257, 3, 1, height);
  entry(258, 3, samples, samples > 2 ? depths : bits | (samples == 2 ? bits << 16 : 0));
  entry(259, 3, 1, 1);
  entry(262, 3, 1, photometric);
  entry(273, 4, 1, start);
  entry(274, 3, 1, 1);
  entry(277, 3, 1, samples);
  entry(278, 3, 1, height);
  entry(279, 4, 1, static_cast<std::uint32_t>(data.size()));
  entry(284, 3, 1, 1);
  if (extra > 0) entry(338, 3, 1, extra);
  std::string file = "II" + little(42, 2) + little(8, 4) + little(count, 2);
  for (const std::string& one : entries) file += one;
  return file + little(0, 4) + little(bits, 2) + little(bits, 2) + little(bits, 2) + little(bits, 2) + data;
}

}  // namespace batten::test
