// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_reader.h"

#include <algorithm>
#include <new>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/regular_file.h"
#include "core/image/file/decode_file.h"
#include "core/image/file/pdf_scan.h"
#include "core/image/file/scan_file.h"
#include "core/image/file/scan_grey.h"
#include "core/image/file/scan_header.h"

namespace batten {
namespace {

/// [px] Tiles may be larger than the picture, as pictures of any size are cut into the same tiles; a bigger one of a
/// small picture is damage, or is meant to take memory.
constexpr std::uint64_t kMostTilePixels = std::uint64_t{1} << 22;
constexpr std::uint64_t kMostTilesWorth = 4;    // pictures: see above
constexpr std::uint64_t kProbeBytes = 1 << 20;  // headers lie within; EXIF blocks take up to 64 kB

Result<ScanHeader> headerOf(const std::filesystem::path& path, const std::vector<std::byte>& bytes, int page) {
  const auto header = readScanHeader(ByteReader(bytes), page);
  if (!header) {
    return unreadable(path,
                      "is not a PNG, JPEG, TIFF, PDF, JPEG 2000, BMP, WebP or PNM image, whatever its name says; "
                      "export it as PNG.");
  }
  return *header;
}

bool hasPage(const ScanHeader& header, int page) {
  return page >= 1 && page <= header.pages && (header.info.format != "TIFF" || header.directoryAt);
}

/// TIFF directories may lie at the end of the file; then the whole is read.
Result<ScanHeader> probe(const std::filesystem::path& path, const RegularFile& file, int page) {
  const std::uint64_t size = file.size();
  auto bytes = readBytes(path, file, std::min(size, kProbeBytes));
  if (!bytes) return fail(bytes.error());
  auto header = headerOf(path, *bytes, page);
  if (header && size > kProbeBytes && (header->info.width <= 0 || header->info.height <= 0)) {
    bytes = readBytes(path, file, size);
    if (!bytes) return fail(bytes.error());
    header = headerOf(path, *bytes, page);
  }
  if (header && !hasPage(*header, page)) return fail(noSuchPage(path, page, header->pages));
  if (header && (header->info.width <= 0 || header->info.height <= 0)) {
    return unreadable(path, "states no picture size; it is damaged or truncated. Scan or copy it again.");
  }
  return header;
}

/// The decoder holds one tile at a time, of four channels.
std::uint64_t tileBytes(const ScanHeader& header) {
  return header.tilePixels * (header.info.bitsPerChannel > 8 ? 8 : 4);
}

/// What reading takes at its peak: the file, the decoded picture, its grey and colours, and a rotated copy.
std::uint64_t memoryNeeded(const ScanHeader& header, std::uint64_t fileBytes) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(header.info.width) * static_cast<std::uint64_t>(header.info.height);
  std::uint64_t channels = static_cast<std::uint64_t>(std::max(1, header.info.channels));
  if (channels == 2) channels = 4;  // grey with alpha is decoded as colour with alpha
  const std::uint64_t sample = header.info.bitsPerChannel > 8 ? 2 : 1;
  const std::uint64_t decoded =
      pixels * channels * sample + (header.progressive ? pixels * channels * 2 : 0) + header.workBytes;
  const std::uint64_t kept = pixels * (channels >= 3 ? 5 : 2);  // grey of 16 bit, colours of 3 x 8
  return fileBytes + kept + std::max(decoded + tileBytes(header), header.info.exifOrientation > 1 ? kept : 0);
}

std::optional<Error> checkSize(const std::filesystem::path& path, const ScanHeader& header, std::uint64_t fileBytes,
                               const ScanRequest& request) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(header.info.width) * static_cast<std::uint64_t>(header.info.height);
  if (header.tilePixels > std::max(kMostTilePixels, kMostTilesWorth * pixels)) {
    return unreadable(path,
                      "is damaged: it states tiles far larger than its picture. Scan it again or export it as PNG.")
        .value();
  }
  return checkCost(path, {header.info.width, header.info.height, memoryNeeded(header, fileBytes), fileBytes},
                   request.memoryBytes, "Scan at a lower resolution or crop.");
}

/// The decoder reads the first page: the chosen one becomes it.
void selectTiffPage(std::vector<std::byte>& bytes, const ScanHeader& header) {
  if (header.info.format != "TIFF" || !header.directoryAt || bytes.size() < 8) return;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t shift = 8 * (header.bigEndian ? 3 - i : i);
    bytes[4 + i] = static_cast<std::byte>(*header.directoryAt >> shift & 0xffu);
  }
}

/// The decoder would turn TIFFs by itself, and only some of them: it is told that there is nothing to turn.
void clearTiffOrientation(std::vector<std::byte>& bytes, const ScanHeader& header) {
  if (header.info.format != "TIFF" || !header.orientationAt || *header.orientationAt + 2 > bytes.size()) return;
  const std::uint64_t at = *header.orientationAt;
  bytes[at] = std::byte{static_cast<unsigned char>(header.bigEndian ? 0 : 1)};
  bytes[at + 1] = std::byte{static_cast<unsigned char>(header.bigEndian ? 1 : 0)};
}

Result<Scan> readChecked(const std::filesystem::path& path, const RegularFile& file, const PageChoice& page,
                         const RunContext& context) {
  auto bytes = readBytes(path, file, file.size());
  if (!bytes) return fail(bytes.error());
  const auto header = headerOf(path, *bytes, page.number);
  if (!header) return fail(header.error());
  if (!hasPage(*header, page.number)) return fail(noSuchPage(path, page.number, header->pages));
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
  scan.page = page;
  scan.pages = header->pages;
  std::optional<DecodedPicture> picture;
  if (header->info.format == "TIFF") {
    scan.fileHash = sha256(*bytes);  // before the file is changed for the decoder
    selectTiffPage(*bytes, *header);
    clearTiffOrientation(*bytes, *header);
    if (context.isCancelled()) return cancelled();
    picture = decodePicture(*bytes, header->meaning, context);
  } else {
    parallelFor(context, 2, 1, [&](int part, int) {
      if (part == 0) picture = decodePicture(*bytes, header->meaning, context);
      if (part == 1) scan.fileHash = sha256(*bytes);
    });
  }
  if (context.isCancelled()) return cancelled();
  if (!picture || picture->grey.width != header->info.width || picture->grey.height != header->info.height) {
    if (!picture && !hasRareDecoder()) {
      return unreadable(path,
                        "needs the program's file libbatten-pictures, which is missing. Install the program again.");
    }
    return unreadable(path, "is damaged or of a rare kind that cannot be decoded. Scan it again or export it as PNG.");
  }
  std::vector<std::byte>().swap(*bytes);
  scan.grey = rotateUpright(std::move(picture->grey), scan.info.exifOrientation, context);
  scan.colour = rotateUpright(std::move(picture->colour), scan.info.exifOrientation, context);
  if (context.isCancelled()) return cancelled();
  return scan;
}

}  // namespace

Result<ScanInfo> probeScan(const std::filesystem::path& path, const PageChoice& page) {
  try {
    const auto file = openedScan(path);
    if (!file) return fail(file.error());
    if (isPdf(*file)) return probePdf(path, *file, page);
    auto header = probe(path, *file, page.number);
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
    const auto file = openedScan(path);
    if (!file || file->size() > kLargestScanBytes) return 1;
    if (isPdf(*file)) return countPdfPages(path, *file);
    auto header = probe(path, *file, 1);
    if (!header || header->info.format != "TIFF") return 1;
    // Directories may lie anywhere in the file.
    const auto bytes = readBytes(path, *file, file->size());
    if (bytes) header = headerOf(path, *bytes, 1);
    return header ? header->pages : 1;
  } catch (const std::bad_alloc&) {
    return 1;
  } catch (const std::filesystem::filesystem_error&) {
    return 1;
  }
}

Result<Scan> readScan(const std::filesystem::path& path, const ScanRequest& request, const RunContext& context) {
  try {
    if (auto wrong = validate(request.page)) return fail(std::move(*wrong));
    const auto file = openedScan(path);
    if (!file) return fail(file.error());
    if (isPdf(*file)) return readPdfScan(path, *file, {request.page, request.memoryBytes}, context);
    const auto header = probe(path, *file, request.page.number);
    if (!header) return fail(header.error());
    if (const auto error = checkSize(path, *header, file->size(), request)) return fail(*error);
    return readChecked(path, *file, request.page, context);
  } catch (const std::bad_alloc&) {
    return unreadable(path, "needs more memory than there is. Scan at a lower resolution or crop.");
  } catch (const cv::Exception& exception) {
    if (exception.code == cv::Error::StsNoMem)
      return unreadable(path, "needs more memory than there is. Scan at a lower resolution or crop.");
    return unreadable(path, "cannot be decoded; it is damaged or too large. Export it as PNG or scan it again.",
                      exception.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return unreadable(path, "cannot be read; check the path and its permissions.", error.what());
  }
}

}  // namespace batten
