// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/image/file/scan_header_exif.h"
#include "core/image/file/scan_header_jp2.h"

namespace batten {
namespace {

/// [k][byte]: what a byte adds to the check sum of the k bytes after it.
using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

CrcTables crcTables() {
  CrcTables tables{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    tables[0][n] = c;
  }
  for (std::size_t k = 1; k < tables.size(); ++k) {
    for (std::size_t n = 0; n < 256; ++n) tables[k][n] = tables[0][tables[k - 1][n] & 0xffu] ^ (tables[k - 1][n] >> 8);
  }
  return tables;
}

/// The check sum of PNG chunks: a chunk that fails it makes the decoder complain on stderr, so it is found here.
bool crcFits(const ByteReader& file, std::uint64_t begin, std::uint64_t count) {
  static const CrcTables kTables = crcTables();
  std::uint32_t crc = 0xffffffffu;
  std::span<const std::byte> left = file.bytes().subspan(begin, count);
  const auto at = [&](std::size_t i) { return std::to_integer<std::uint32_t>(left[i]); };
  // Eight bytes at a time: their tables do not wait for one another.
  for (; left.size() >= 8; left = left.subspan(8)) {
    const std::uint32_t first = crc ^ (at(0) | at(1) << 8 | at(2) << 16 | at(3) << 24);
    crc = kTables[7][first & 0xffu] ^ kTables[6][first >> 8 & 0xffu] ^ kTables[5][first >> 16 & 0xffu] ^
          kTables[4][first >> 24] ^ kTables[3][at(4)] ^ kTables[2][at(5)] ^ kTables[1][at(6)] ^ kTables[0][at(7)];
  }
  for (const std::byte value : left) {
    crc = kTables[0][(crc ^ std::to_integer<std::uint32_t>(value)) & 0xffu] ^ (crc >> 8);
  }
  return (crc ^ 0xffffffffu) == file.u32(begin + count);
}

/// Number at `at` in a PNM header, comments and white space skipped; `at` moves behind it.
int pnmNumber(const ByteReader& file, std::uint64_t& at) {
  const auto isSpace = [](std::uint32_t c) { return c == ' ' || (c >= 9 && c <= 13); };
  while (file.has(at, 1) && (isSpace(file.u8(at)) || file.u8(at) == '#')) {
    if (file.u8(at) == '#') {
      while (file.has(at, 1) && file.u8(at) != '\n') ++at;
    } else {
      ++at;
    }
  }
  int value = 0;
  while (file.u8(at) >= '0' && file.u8(at) <= '9' && value < 100'000'000) {
    value = value * 10 + static_cast<int>(file.u8(at++) - '0');
  }
  return value;
}

}  // namespace

std::optional<double> plausibleDpi(double xDpi, double yDpi) {
  constexpr double kLowest = 20.0, kHighest = 20000.0;  // [dpi] what lies beyond is no resolution
  constexpr double kUnequal = 0.02;                     // of a pixel that is no square, as of a fax
  if (!(xDpi >= kLowest && xDpi <= kHighest && yDpi > 0.0) || std::fabs(xDpi / yDpi - 1.0) > kUnequal)
    return std::nullopt;
  return xDpi;
}

std::optional<double> plausibleDpiOfMetres(double xPerMetre, double yPerMetre) {
  constexpr double kMostOff = 0.02;  // [dpi] half a dot per metre is .013
  const auto dpi = plausibleDpi(xPerMetre * kMetresPerInch, yPerMetre * kMetresPerInch);
  return dpi && std::fabs(*dpi - std::round(*dpi)) < kMostOff ? std::optional(std::round(*dpi)) : dpi;
}

ScanHeader readPngHeader(const ByteReader& file) {
  ScanHeader header;
  header.info.format = "PNG";
  header.info.width = static_cast<int>(file.u32(16) & 0x7fffffffu);
  header.info.height = static_cast<int>(file.u32(20) & 0x7fffffffu);
  header.info.bitsPerChannel = static_cast<int>(file.u8(24));
  const std::uint32_t colour = file.u8(25);
  header.info.channels = colour == 2 ? 3 : colour == 3 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1;
  bool ended = false;
  std::uint64_t at = 8;
  while (!ended && header.complete && file.has(at, 12)) {
    const std::uint64_t length = file.u32(at);
    if (!file.has(at, length + 12) || !crcFits(file, at + 4, length + 4)) {
      header.complete = false;
      break;
    }
    if (file.matches(at + 4, "pHYs") && file.u8(at + 16) == 1) {
      header.info.dpi = plausibleDpiOfMetres(file.u32(at + 8), file.u32(at + 12));
    } else if (file.matches(at + 4, "tRNS") && (colour == 2 || colour == 3)) {
      header.info.channels = 4;  // the decoder makes alpha of it
    } else if (file.matches(at + 4, "tRNS") && colour == 0 && length >= 2) {
      header.meaning.transparent = static_cast<std::uint16_t>(file.u16(at + 8));
    } else if (file.matches(at + 4, "eXIf")) {
      const bool big = file.matches(at + 8, "MM");
      const TiffTags tags = readTiffTags(file.part(at + 8, length, big));
      header.info.exifOrientation = tags.orientation ? tags.orientation->value : 1;
    }
    ended = file.matches(at + 4, "IEND");
    at += length + 12;
  }
  header.meaning.bits = header.info.bitsPerChannel;
  header.complete = header.complete && ended;
  return header;
}

ScanHeader readBmpHeader(const ByteReader& bytes) {
  const ByteReader file = bytes.part(0, bytes.size(), false);
  ScanHeader header;
  header.info.format = "BMP";
  const bool old = file.u32(14) == 12;
  const auto rows = static_cast<std::int32_t>(old ? file.u16(20) : file.u32(22));
  header.info.width = static_cast<int>(old ? file.u16(18) : file.u32(18));
  header.info.height = rows == INT32_MIN ? 0 : std::abs(rows);
  const std::uint32_t bits = old ? file.u16(24) : file.u16(28);
  const std::uint32_t compression = old ? 0 : file.u32(30);
  header.info.channels = bits == 32 ? 4 : 3;
  header.info.bitsPerChannel = bits >= 16 ? 8 : static_cast<int>(bits);
  if (!old) {
    header.info.dpi = plausibleDpiOfMetres(file.u32(38), file.u32(42));
  }
  const std::uint64_t stride = (static_cast<std::uint64_t>(std::max(header.info.width, 0)) * bits + 31) / 32 * 4;
  const bool plain = compression == 0 || compression == 3;
  header.complete = file.has(file.u32(10), plain ? stride * static_cast<std::uint64_t>(header.info.height) : 1);
  return header;
}

ScanHeader readWebpHeader(const ByteReader& bytes) {
  const ByteReader file = bytes.part(0, bytes.size(), false);
  ScanHeader header;
  header.info.format = "WebP";
  header.info.channels = 3;
  const std::uint64_t end = static_cast<std::uint64_t>(file.u32(4)) + 8;
  header.complete = end <= file.size() + 1 && end > 20;
  if (file.matches(12, "VP8X")) {
    header.info.width = static_cast<int>(file.u24(24)) + 1;
    header.info.height = static_cast<int>(file.u24(27)) + 1;
    header.info.channels = (file.u8(20) & 0x10u) != 0 ? 4 : 3;
    for (std::uint64_t at = 12; file.has(at, 8); at += 8 + ((file.u32(at + 4) + 1ull) & ~1ull)) {
      if (!file.matches(at, "EXIF")) continue;
      const std::uint64_t skip = file.matches(at + 8, "Exif") ? 6 : 0;
      const std::uint64_t count = file.u32(at + 4);
      if (count <= skip) continue;
      const bool big = file.matches(at + 8 + skip, "MM");
      header = readTiffTags(file.part(at + 8 + skip, count - skip, big)).in(std::move(header));
    }
  } else if (file.matches(12, "VP8L")) {
    const std::uint32_t bits = file.u32(21);
    header.info.width = static_cast<int>(bits & 0x3fffu) + 1;
    header.info.height = static_cast<int>((bits >> 14) & 0x3fffu) + 1;
    header.info.channels = (bits >> 28 & 1u) != 0 ? 4 : 3;
  } else {
    header.info.width = static_cast<int>(file.u16(26) & 0x3fffu);
    header.info.height = static_cast<int>(file.u16(28) & 0x3fffu);
  }
  return header;
}

ScanHeader readPnmHeader(const ByteReader& file) {
  ScanHeader header;
  header.info.format = "PNM";
  const std::uint32_t kind = file.u8(1) - '0';
  std::uint64_t at = 2;
  header.info.width = pnmNumber(file, at);
  header.info.height = pnmNumber(file, at);
  const bool bitmap = kind == 1 || kind == 4;
  const int largest = bitmap ? 1 : pnmNumber(file, at);
  header.info.channels = kind == 3 || kind == 6 ? 3 : 1;
  header.info.bitsPerChannel = bitmap ? 1 : largest > 255 ? 16 : 8;
  header.supported = largest > 0 && largest < 65536;
  const auto samples = static_cast<std::uint64_t>(header.info.width) * static_cast<std::uint64_t>(header.info.channels);
  const auto rows = static_cast<std::uint64_t>(header.info.height);
  // In text form every sample takes at least one digit, and all but those of bitmaps a separator.
  const std::uint64_t stride = kind >= 4 ? (kind == 4 ? (samples + 7) / 8 : samples * (largest > 255 ? 2u : 1u))
                                         : (kind == 1 ? samples : samples * 2);
  header.complete = file.has(at, kind >= 4 ? stride * rows + 1 : stride * rows);
  return header;
}

std::optional<ScanHeader> readScanHeader(const ByteReader& file, int page) {
  if (file.matches(0, "\x89PNG\r\n\x1a\n")) return readPngHeader(file);
  if (file.matches(0, "\xff\xd8\xff")) return readJpegHeader(file);
  if (file.matches(0, std::string_view("II*\0", 4)) || file.matches(0, std::string_view("MM\0*", 4))) {
    return readTiffHeader(file, page);
  }
  if (file.matches(0, "BM") && file.part(0, file.size(), false).u32(14) <= 124 && file.size() > 26) {
    return readBmpHeader(file);
  }
  if (isJpeg2000(file)) return readJpeg2000Header(file);
  if (file.matches(0, "RIFF") && file.matches(8, "WEBP")) return readWebpHeader(file);
  if (file.u8(0) == 'P' && file.u8(1) >= '1' && file.u8(1) <= '6' && file.u8(2) <= ' ' && file.size() > 6) {
    return readPnmHeader(file);
  }
  return std::nullopt;
}

}  // namespace batten
