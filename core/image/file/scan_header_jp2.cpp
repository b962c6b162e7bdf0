// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_header_jp2.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace batten {
namespace {

using namespace std::string_view_literals;

constexpr auto kJp2Begin = "\0\0\0\x0cjP  \r\n\x87\n"sv;                       // signature box
constexpr auto kCodestreamBegin = "\xff\x4f\xff\x51"sv;                        // start of codestream, size
constexpr std::uint32_t kStartOfTilePart = 0xff90, kEndOfCodestream = 0xffd9;  // markers

/// A box of the file: its type, and where its content lies.
struct Box {
  std::uint64_t type = 0, begin = 0, end = 0;
};

constexpr std::uint32_t boxType(std::string_view name) {
  std::uint32_t type = 0;
  for (const char c : name) type = type << 8 | static_cast<unsigned char>(c);
  return type;
}

/// The box at `at`, which ends by `end` at the latest; a size of 0 goes to the end, of 1 stands in 64 bit behind.
bool boxAt(const ByteReader& file, std::uint64_t at, std::uint64_t end, Box& box) {
  if (at + 8 > end || !file.has(at, 8)) return false;
  std::uint64_t size = file.u32(at), head = 8;
  if (size == 1) {
    size = static_cast<std::uint64_t>(file.u32(at + 8)) << 32 | file.u32(at + 12);
    head = 16;
  }
  if (size == 0 || size > end - at) size = end - at;  // truncated: what there is of it
  if (size < head) return false;
  box = {file.u32(at + 4), at + head, at + size};
  return true;
}

/// Dots per inch of a resolution box: places per metre as a fraction times a power of ten, down and across.
std::optional<double> resolutionOf(const ByteReader& file, std::uint64_t at) {
  const auto perMetre = [&](std::uint64_t ratio, std::uint64_t exponent) {
    const double below = file.u16(at + ratio + 2);
    const int power = static_cast<int>(file.u8(at + exponent));
    return below > 0.0 ? file.u16(at + ratio) / below * std::pow(10.0, power < 128 ? power : power - 256) : 0.0;
  };
  return plausibleDpiOfMetres(perMetre(4, 9), perMetre(0, 8));
}

/// The resolution in the header box, that of the scanner before that of a display.
std::optional<double> resolutionIn(const ByteReader& file, const Box& header) {
  Box box, inner;
  std::optional<double> shown;
  for (std::uint64_t at = header.begin; boxAt(file, at, header.end, box); at = box.end) {
    if (box.type != boxType("res ")) continue;
    for (std::uint64_t in = box.begin; boxAt(file, in, box.end, inner); in = inner.end) {
      if (inner.end - inner.begin < 10) continue;
      if (inner.type == boxType("resc")) return resolutionOf(file, inner.begin);
      if (inner.type == boxType("resd")) shown = resolutionOf(file, inner.begin);
    }
  }
  return shown;
}

/// Whether the parts of the tiles follow each other up to the end of the codestream.
bool isComplete(const ByteReader& file, std::uint64_t at, std::uint64_t end) {
  const auto segment = [&] { return 2 + file.u16(at + 2); };
  at += 2;  // start of codestream
  while (at + 4 <= end && file.u16(at) != kStartOfTilePart) {
    if (file.u16(at) < 0xff00 || segment() < 4) return false;
    at += segment();
  }
  while (at + 12 <= end && file.u16(at) == kStartOfTilePart) {
    const std::uint64_t length = file.u32(at + 6);
    // The last part may go on to the end without saying where that is.
    if (length == 0) return end >= at + 14 && file.u16(end - 2) == kEndOfCodestream;
    if (length < 14 || length > end - at) return false;
    at += length;
  }
  return at + 2 <= end && file.u16(at) == kEndOfCodestream;
}

/// The size marker, behind the start of the codestream at `at`.
void readSize(const ByteReader& file, std::uint64_t at, ScanHeader& header) {
  const std::uint64_t size = at + 2;  // its marker
  const auto number = [&](std::uint64_t field) { return static_cast<std::int64_t>(file.u32(size + field)); };
  const std::int64_t width = number(6) - number(14), height = number(10) - number(18);
  const std::int64_t tileWidth = number(22), tileHeight = number(26);
  const std::uint32_t components = file.u16(size + 38);
  constexpr std::int64_t kMost = INT32_MAX, kMostTiles = 65535;  // what the format can count
  const bool isSize = width > 0 && height > 0 && width <= kMost && height <= kMost && tileWidth > 0 && tileHeight > 0;
  if (!isSize || components == 0 || file.u16(size + 2) != 38 + 3 * components) return;
  const double tiles = std::ceil(static_cast<double>(width) / static_cast<double>(tileWidth)) *
                       std::ceil(static_cast<double>(height) / static_cast<double>(tileHeight));
  if (tiles > static_cast<double>(kMostTiles)) return;
  header.info.width = static_cast<int>(width);
  header.info.height = static_cast<int>(height);
  header.info.channels = static_cast<int>(components);
  header.supported = components <= 4;
  for (std::uint64_t i = 0; i < components; ++i) {
    const std::uint32_t depth = file.u8(size + 40 + 3 * i);
    const int bits = static_cast<int>(depth & 0x7fu) + 1;
    if (i == 0) header.info.bitsPerChannel = bits;
    const bool isWhole = file.u8(size + 41 + 3 * i) == 1 && file.u8(size + 42 + 3 * i) == 1;
    header.supported = header.supported && depth < 0x80 && bits <= 16 && isWhole;
  }
  // It decodes to 32 bit a sample, once for the tiles and once for the picture.
  constexpr std::uint64_t kBytesPerSample = 8;
  header.workBytes =
      kBytesPerSample * components * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

}  // namespace

bool isJpeg2000(const ByteReader& file) { return file.matches(0, kJp2Begin) || file.matches(0, kCodestreamBegin); }

ScanHeader readJpeg2000Header(const ByteReader& file) {
  ScanHeader header;
  header.info.format = "JPEG 2000";
  header.complete = false;
  Box box{0, 0, file.size()};
  bool hasCodestream = file.matches(0, kCodestreamBegin);
  if (!hasCodestream) {
    for (std::uint64_t at = 0; !hasCodestream && boxAt(file, at, file.size(), box); at = box.end) {
      if (box.type == boxType("jp2h")) header.info.dpi = resolutionIn(file, box);
      hasCodestream = box.type == boxType("jp2c") && file.matches(box.begin, kCodestreamBegin);
    }
  }
  if (!hasCodestream) return header;
  readSize(file, box.begin, header);
  header.complete = isComplete(file, box.begin, box.end);
  return header;
}

}  // namespace batten
