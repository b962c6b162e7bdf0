// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/scan_reader.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/base/platform.h"
#include "core/base/regular_file.h"
#include "core/base/shown_text.h"
#include "core/image/scan_grey.h"
#include "core/image/scan_header.h"

namespace batten {
namespace {

constexpr std::uint64_t kLargestFile = std::numeric_limits<int>::max();  // the decoder counts bytes by int
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;            // the decoder's own limit
constexpr double kShareOfFreeMemory = 0.8;                               // the later stages need some too
/// [px] Tiles may be larger than the picture, as pictures of any size are cut into the same tiles; a bigger one of a
/// small picture is damage, or is meant to take memory.
constexpr std::uint64_t kMostTilePixels = std::uint64_t{1} << 22;
constexpr std::uint64_t kMostTilesWorth = 4;
constexpr std::uint64_t kProbeBytes = 1 << 20;  // headers lie within; EXIF blocks take up to 64 kB

tl::unexpected<Error> unreadable(const std::filesystem::path& path, const std::string& what, std::string detail = {}) {
  std::string message(1, '"');
  message.append(shownName(path)).append("\" ").append(what);
  return fail(ErrorCode::UnreadableScan, std::move(message), std::move(detail));
}

tl::unexpected<Error> unreadable(const std::filesystem::path& path, FileProblem problem) {
  switch (problem) {
    case FileProblem::Missing:
      return unreadable(path, "does not exist; check the path.");
    case FileProblem::Folder:
      return unreadable(path, "is a directory; choose an image file in it.");
    case FileProblem::NotOrdinary:
      return unreadable(path, "is not a file; choose an image file.");
    case FileProblem::NotAllowed:
      return unreadable(path, "cannot be opened; check its permissions.");
    case FileProblem::TooLarge:
    case FileProblem::Broken:
      break;
  }
  return unreadable(path, "could not be read to its end; copy it again.");
}

Result<RegularFile> opened(const std::filesystem::path& path) {
  auto file = RegularFile::open(path);
  if (!file) return unreadable(path, file.error());
  if (file->size() == 0) return unreadable(path, "is empty (0 bytes); scan or copy it again.");
  return std::move(*file);
}

Result<std::vector<std::byte>> readBytes(const std::filesystem::path& path, const RegularFile& file,
                                         std::uint64_t count) {
  std::vector<std::byte> bytes(count);
  if (const auto read = file.read(bytes); !read) return unreadable(path, read.error());
  return bytes;
}

Result<ScanHeader> headerOf(const std::filesystem::path& path, const std::vector<std::byte>& bytes) {
  const auto header = readScanHeader(ByteReader(bytes));
  if (!header) {
    return unreadable(path,
                      "is not a PNG, JPEG, TIFF, BMP, WebP or PNM image, whatever its name says; export it as PNG.");
  }
  return *header;
}

/// TIFF directories may lie at the end of the file; then the whole is read.
Result<ScanHeader> probe(const std::filesystem::path& path, const RegularFile& file) {
  const std::uint64_t size = file.size();
  auto bytes = readBytes(path, file, std::min(size, kProbeBytes));
  if (!bytes) return fail(bytes.error());
  auto header = headerOf(path, *bytes);
  if (header && size > kProbeBytes && (header->info.width <= 0 || header->info.height <= 0)) {
    bytes = readBytes(path, file, size);
    if (!bytes) return fail(bytes.error());
    header = headerOf(path, *bytes);
  }
  if (header && (header->info.width <= 0 || header->info.height <= 0)) {
    return unreadable(path, "states no picture size; it is damaged or truncated. Scan or copy it again.");
  }
  return header;
}

/// The decoder holds one tile at a time, of four channels.
std::uint64_t tileBytes(const ScanHeader& header) {
  return header.tilePixels * (header.info.bitsPerChannel > 8 ? 8 : 4);
}

/// What reading takes at its peak: the file, the decoded picture, its grey, and a turned copy.
std::uint64_t memoryNeeded(const ScanHeader& header, std::uint64_t fileBytes) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(header.info.width) * static_cast<std::uint64_t>(header.info.height);
  std::uint64_t channels = static_cast<std::uint64_t>(std::max(1, header.info.channels));
  if (channels == 2) channels = 4;  // grey with alpha is decoded as colour with alpha
  const std::uint64_t sample = header.info.bitsPerChannel > 8 ? 2 : 1;
  const std::uint64_t decoded = pixels * channels * sample + (header.progressive ? pixels * channels * 2 : 0);
  const std::uint64_t grey = pixels * 2;
  return fileBytes + grey + std::max(decoded + tileBytes(header), header.info.exifOrientation > 1 ? grey : 0);
}

/// With two digits behind the point, whatever the locale.
std::string gigabytes(std::uint64_t bytes) {
  constexpr std::uint64_t kHundredth = 10'000'000;
  const std::uint64_t hundredths = (bytes + kHundredth / 2) / kHundredth;
  const std::string digits = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + (digits.size() == 1 ? ".0" : ".") + digits + " GB";
}

std::optional<Error> checkSize(const std::filesystem::path& path, const ScanHeader& header, std::uint64_t fileBytes,
                               const ScanLimits& limits) {
  const std::string size = std::to_string(header.info.width) + " x " + std::to_string(header.info.height) + " px";
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(header.info.width) * static_cast<std::uint64_t>(header.info.height);
  if (header.tilePixels > std::max(kMostTilePixels, kMostTilesWorth * pixels)) {
    return unreadable(path,
                      "is damaged: it states tiles far larger than its picture. Scan it again or export it as PNG.")
        .value();
  }
  const std::uint64_t needed = memoryNeeded(header, fileBytes);
  std::optional<std::uint64_t> available = limits.memoryBytes;
  if (!available) {
    if (const auto free = availableMemoryBytes()) {
      available = static_cast<std::uint64_t>(kShareOfFreeMemory * static_cast<double>(*free));
    }
  }
  if (available && needed > *available) {
    return unreadable(path, "is too large: " + size + " need " + gigabytes(needed) + " of memory, " +
                                gigabytes(*available) + " are free. Scan at a lower resolution or crop.")
        .value();
  }
  if (pixels > kMostPixels || fileBytes > kLargestFile) {
    return unreadable(path, "is too large: " + size + " (" + gigabytes(fileBytes) +
                                " file) is more than can be read. Scan at a lower resolution or crop.")
        .value();
  }
  return std::nullopt;
}

/// The decoder would turn TIFFs by itself, and only some of them: it is told that there is nothing to turn.
void clearTiffOrientation(std::vector<std::byte>& bytes, const ScanHeader& header) {
  const auto at = static_cast<std::size_t>(header.orientationAt);
  if (header.info.format != "TIFF" || at == 0 || at + 2 > bytes.size()) return;
  bytes[at] = std::byte{static_cast<unsigned char>(header.bigEndian ? 0 : 1)};
  bytes[at + 1] = std::byte{static_cast<unsigned char>(header.bigEndian ? 1 : 0)};
}

Result<Scan> readChecked(const std::filesystem::path& path, const RegularFile& file, const RunContext& context) {
  auto bytes = readBytes(path, file, file.size());
  if (!bytes) return fail(bytes.error());
  const auto header = headerOf(path, *bytes);
  if (!header) return fail(header.error());
  if (!header->complete)
    return unreadable(path, "is truncated or damaged: part of the picture is missing. Scan or copy it again.");
  if (!header->supported) {
    return unreadable(path,
                      "holds a kind of pixels that cannot be read; export it as PNG with 8 or 16 bit per channel.");
  }
  Scan scan;
  scan.info = header->info;
  scan.dpi = header->info.dpi;
  scan.path = path.string();
  scan.fileHash = sha256(*bytes);
  if (context.isCancelled()) return cancelled();
  clearTiffOrientation(*bytes, *header);
  auto grey = decodeGrey(*bytes, header->meaning, context);
  if (context.isCancelled()) return cancelled();
  if (!grey || grey->width != header->info.width || grey->height != header->info.height) {
    return unreadable(path, "is damaged or of a rare kind that cannot be decoded. Scan it again or export it as PNG.");
  }
  std::vector<std::byte>().swap(*bytes);
  scan.grey = turnUpright(std::move(*grey), scan.info.exifOrientation, context);
  if (context.isCancelled()) return cancelled();
  return scan;
}

}  // namespace

Result<ScanInfo> probeScan(const std::filesystem::path& path) {
  try {
    const auto file = opened(path);
    if (!file) return fail(file.error());
    auto header = probe(path, *file);
    if (!header) return fail(header.error());
    return header->info;
  } catch (const std::bad_alloc&) {
    return unreadable(path, "needs more memory than there is; close other programs.");
  } catch (const std::filesystem::filesystem_error& error) {
    return unreadable(path, "cannot be read; check the path and its permissions.", error.what());
  }
}

int countPages(const std::filesystem::path& path) {
  try {
    const auto file = opened(path);
    if (!file) return 1;
    auto header = probe(path, *file);
    if (!header || header->info.format != "TIFF" || file->size() > kLargestFile) return 1;
    // Directories may lie anywhere in the file.
    const auto bytes = readBytes(path, *file, file->size());
    if (bytes) header = headerOf(path, *bytes);
    return header ? header->pages : 1;
  } catch (const std::bad_alloc&) {
    return 1;
  } catch (const std::filesystem::filesystem_error&) {
    return 1;
  }
}

Result<Scan> readScan(const std::filesystem::path& path, const ScanLimits& limits, const RunContext& context) {
  try {
    const auto file = opened(path);
    if (!file) return fail(file.error());
    const auto header = probe(path, *file);
    if (!header) return fail(header.error());
    if (const auto error = checkSize(path, *header, file->size(), limits)) return fail(*error);
    return readChecked(path, *file, context);
  } catch (const std::bad_alloc&) {
    return unreadable(path, "needs more memory than there is. Scan at a lower resolution or crop.");
  } catch (const cv::Exception& exception) {
    return unreadable(path, "cannot be decoded; it is damaged or too large. Export it as PNG or scan it again.",
                      exception.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return unreadable(path, "cannot be read; check the path and its permissions.", error.what());
  }
}

}  // namespace batten
