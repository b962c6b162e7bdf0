// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_header_exif.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/base/conventions.h"
#include "core/image/file/scan_header.h"

namespace batten {
namespace {

constexpr std::uint64_t kLargestTagCount = 1'000'000;  // of strips or tiles; guards against damaged files

struct Tag {
  std::uint32_t type = 0;
  std::uint64_t count = 0;
  std::uint64_t at = 0;  ///< Where its values are.
};

std::uint64_t sizeOfType(std::uint32_t type) {
  switch (type) {
    case 3:
    case 8:
      return 2;
    case 4:
    case 9:
    case 11:
      return 4;
    case 5:
    case 10:
    case 12:
      return 8;
    default:
      return 1;
  }
}

Tag readTag(const ByteReader& tiff, std::uint64_t entry) {
  Tag tag{tiff.u16(entry + 2), tiff.u32(entry + 4), entry + 8};
  if (tag.count * sizeOfType(tag.type) > 4) tag.at = tiff.u32(entry + 8);
  return tag;
}

std::uint64_t valueOf(const ByteReader& tiff, const Tag& tag, std::uint64_t index = 0) {
  const std::uint64_t at = tag.at + index * sizeOfType(tag.type);
  return tag.type == 3 ? tiff.u16(at) : tag.type == 4 ? tiff.u32(at) : tiff.u8(at);
}

double ratioOf(const ByteReader& tiff, const Tag& tag) {
  const double below = tiff.u32(tag.at + 4);
  return below > 0.0 ? tiff.u32(tag.at) / below : 0.0;
}

/// Whether every strip or tile lies inside the file.
bool blocksInside(const ByteReader& tiff, const Tag& offsets, const Tag& sizes) {
  if (offsets.count == 0 || offsets.count != sizes.count || offsets.count > kLargestTagCount) return false;
  for (std::uint64_t i = 0; i < offsets.count; ++i) {
    if (!tiff.has(valueOf(tiff, offsets, i), valueOf(tiff, sizes, i))) return false;
  }
  return true;
}

/// Where the directories of a file lie, those of thumbnails and masks left out. A chain that leads back into itself
/// ends there.
std::vector<std::uint64_t> tiffPages(const ByteReader& tiff) {
  constexpr std::size_t kMostPages = 10000;             // guards against chains of directories without end
  constexpr std::uint64_t kIsReduced = 1, kIsMask = 4;  // bits of NewSubfileType
  std::set<std::uint64_t> seen;
  std::vector<std::uint64_t> pages;
  for (std::uint64_t directory = tiff.u32(4); directory >= 8 && tiff.has(directory, 2) && seen.size() < kMostPages;) {
    if (!seen.insert(directory).second) break;
    const std::uint64_t entries = tiff.u16(directory);
    if (!tiff.has(directory, 2 + entries * 12)) break;
    std::uint64_t kind = 0;
    for (std::uint64_t i = 0; i < entries; ++i) {
      const std::uint64_t entry = directory + 2 + i * 12;
      if (tiff.u16(entry) == 254) kind = valueOf(tiff, readTag(tiff, entry));
    }
    if ((kind & (kIsReduced | kIsMask)) == 0) pages.push_back(directory);
    directory = tiff.u32(directory + 2 + entries * 12);
  }
  if (pages.empty()) pages.push_back(tiff.u32(4));
  return pages;
}

/// What the camera says of its lens, in a directory of its own.
std::optional<double> focal35Of(const ByteReader& tiff, std::uint64_t directory) {
  constexpr double kShortestMm = 5.0, kLongestMm = 2000.0;  // other focal lengths are not believed
  const std::uint64_t entries = tiff.u16(directory);
  for (std::uint64_t i = 0; i < entries && tiff.has(directory + 2 + i * 12, 12); ++i) {
    const std::uint64_t entry = directory + 2 + i * 12;
    if (tiff.u16(entry) != 41989) continue;
    const auto focal = static_cast<double>(valueOf(tiff, readTag(tiff, entry)));
    if (focal >= kShortestMm && focal <= kLongestMm) return focal;  // 0: not known
  }
  return std::nullopt;
}

bool isFrame(std::uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Behind a scan header: the next marker that is neither a stuffed byte nor a restart.
std::uint64_t skipEntropyData(const ByteReader& file, std::uint64_t at) {
  while (file.has(at, 2)) {
    const std::uint32_t next = file.u8(at + 1);
    if (file.u8(at) == 0xff && next != 0 && next != 0xff && !(next >= 0xd0 && next <= 0xd7)) return at;
    ++at;
  }
  return file.size();
}

void readJpegSegment(const ByteReader& file, std::uint32_t marker, std::uint64_t at, std::uint64_t length,
                     ScanHeader& header, std::optional<double>& jfifDpi) {
  if (marker == 0xe0 && file.matches(at, "JFIF")) {
    const double perInch = file.u8(at + 7) == 2 ? kMillimetresPerInch / 10.0 : 1.0;
    if (file.u8(at + 7) != 0) jfifDpi = plausibleDpi(file.u16(at + 8) * perInch, file.u16(at + 10) * perInch);
  } else if (marker == 0xe1 && file.matches(at, "Exif") && length > 6) {
    header = readTiffTags(file.part(at + 6, length - 6, file.matches(at + 6, "MM"))).in(std::move(header));
  } else if (isFrame(marker)) {
    header.info.bitsPerChannel = static_cast<int>(file.u8(at));
    header.info.height = static_cast<int>(file.u16(at + 1));
    header.info.width = static_cast<int>(file.u16(at + 3));
    header.info.channels = static_cast<int>(file.u8(at + 5));
    header.progressive = marker == 0xc2;
  }
}

/// What one directory of a TIFF says of its picture.
class TiffDirectory {
 public:
  TiffDirectory(const ByteReader& tiff, std::uint64_t at, ScanHeader header) : tiff_(tiff), header_(std::move(header)) {
    const std::uint64_t entries = tiff.u16(at);
    header_.directoryAt = at;
    header_.info.bitsPerChannel = 1;
    header_.meaning.isTiff = true;
    header_.complete = at >= 8 && tiff.has(at, 2 + entries * 12);
    for (std::uint64_t i = 0; i < entries && header_.complete; ++i) {
      const std::uint64_t entry = at + 2 + i * 12;
      readField(tiff.u16(entry), readTag(tiff, entry));
    }
    header_.tilePixels = tileWidth_ * tileHeight_;  // 32 bit each
    header_ = readTiffTags(tiff, at).in(std::move(header_));
    if (hasAlpha_ && header_.info.channels == 2) header_.supported = false;  // the decoder would drop the alpha
    header_.complete = header_.complete && blocksInside(tiff, offsets_, sizes_);
  }
  ScanHeader header() && { return std::move(header_); }

 private:
  void readField(std::uint32_t number, const Tag& tag) {
    const auto value = static_cast<int>(std::min<std::uint64_t>(valueOf(tiff_, tag), INT32_MAX));
    switch (number) {
      case 256:
        header_.info.width = value;
        break;
      case 257:
        header_.info.height = value;
        break;
      case 258:
        header_.info.bitsPerChannel = value;
        break;
      case 262:
        if (value == 3) header_.info.channels = 3;
        header_.meaning.minIsWhite = value == 0;
        break;
      case 277:
        header_.info.channels = std::max(header_.info.channels, value);
        break;
      case 322:
        tileWidth_ = valueOf(tiff_, tag);
        break;
      case 323:
        tileHeight_ = valueOf(tiff_, tag);
        break;
      case 273:
      case 324:
        offsets_ = tag;
        break;
      case 279:
      case 325:
        sizes_ = tag;
        break;
      case 338:
        header_.meaning.alphaAssociated = value == 1;
        hasAlpha_ = value == 1 || value == 2;
        break;
      case 339:
        header_.supported = value == 1;
        break;
      default:
        break;
    }
  }

  const ByteReader& tiff_;
  ScanHeader header_;
  Tag offsets_, sizes_;
  std::uint64_t tileWidth_ = 0, tileHeight_ = 0;
  bool hasAlpha_ = false;
};

}  // namespace

ScanHeader TiffTags::in(ScanHeader header) const {
  if (dpi) header.info.dpi = dpi;
  if (focal35Mm) header.info.focal35Mm = focal35Mm;
  if (orientation) {
    header.info.exifOrientation = orientation->value;
    header.orientationAt = orientation->at;
  }
  return header;
}

TiffTags readTiffTags(const ByteReader& tiff) { return readTiffTags(tiff, tiff.u32(4)); }

TiffTags readTiffTags(const ByteReader& tiff, std::uint64_t directory) {
  TiffTags tags;
  const std::uint64_t entries = tiff.u16(directory);
  double xResolution = 0.0, yResolution = 0.0, perInch = 1.0;
  for (std::uint64_t i = 0; i < entries && tiff.has(directory + 2 + i * 12, 12); ++i) {
    const std::uint64_t entry = directory + 2 + i * 12;
    const Tag tag = readTag(tiff, entry);
    switch (tiff.u16(entry)) {
      case 274: {
        const std::uint64_t value = valueOf(tiff, tag);
        if (value >= 1 && value <= 8) tags.orientation = {static_cast<int>(value), tag.at};
        break;
      }
      case 282:
        xResolution = ratioOf(tiff, tag);
        break;
      case 283:
        yResolution = ratioOf(tiff, tag);
        break;
      case 34665:
        tags.focal35Mm = focal35Of(tiff, valueOf(tiff, tag));
        break;
      case 296:
        perInch = valueOf(tiff, tag) == 3 ? kMillimetresPerInch / 10.0 : valueOf(tiff, tag) == 2 ? 1.0 : 0.0;
        break;
      default:
        break;
    }
  }
  tags.dpi = plausibleDpi(xResolution * perInch, yResolution * perInch);
  return tags;
}

ScanHeader readTiffHeader(const ByteReader& file, int page) {
  ScanHeader header;
  header.info.format = "TIFF";
  header.bigEndian = file.matches(0, "MM");
  const ByteReader tiff = file.part(0, file.size(), header.bigEndian);
  const std::vector<std::uint64_t> pages = tiffPages(tiff);
  header.pages = static_cast<int>(pages.size());
  if (page < 1 || page > header.pages) return header;
  return TiffDirectory(tiff, pages[page - 1], std::move(header)).header();
}

ScanHeader readJpegHeader(const ByteReader& file) {
  ScanHeader header;
  header.info.format = "JPEG";
  header.complete = false;
  std::optional<double> jfifDpi;
  std::uint64_t at = 2;
  while (file.has(at, 2)) {
    if (file.u8(at) != 0xff || file.u8(at + 1) == 0xff) {  // fill bytes
      ++at;
      continue;
    }
    const std::uint32_t marker = file.u8(at + 1);
    if (marker == 0xd9) {
      header.complete = true;
      break;
    }
    at += 2;
    if (marker == 0x01 || marker == 0 || (marker >= 0xd0 && marker <= 0xd8)) continue;
    const std::uint64_t length = file.u16(at);
    if (length < 2 || !file.has(at, length)) break;
    readJpegSegment(file, marker, at + 2, length - 2, header, jfifDpi);
    at += length;
    if (marker == 0xda) at = skipEntropyData(file, at);
  }
  header.supported = header.info.bitsPerChannel == 8;
  header.orientationAt.reset();
  if (jfifDpi) header.info.dpi = jfifDpi;
  return header;
}

}  // namespace batten
