// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/scan.h"

namespace batten {

/// Reads only the header of a PNG, JPEG, TIFF, BMP, WebP, JPEG 2000 or PGM/PBM/PPM file, or of a page of a PDF,
/// recognised by content, not by name.
/// @return UnreadableScan with a message that says what to do if the file is missing, a directory, empty, none of
/// these, or has no such page.
Result<ScanInfo> probeScan(const std::filesystem::path& path, const PageChoice& page = {});

/// How many pictures the file holds, thumbnails not counted: a TIFF or PDF may be a stack of pages. 1 where that cannot
/// be known.
int countPages(const std::filesystem::path& path);

struct ScanRequest {
  /// [bytes] Memory that reading may take; absent means what the machine has free.
  std::optional<std::uint64_t> memoryBytes{};
  PageChoice page{};
};

/// Reads a scan: 1 to 16 bit, grey, palette or colour, alpha over white, EXIF rotation applied, resolution from the
/// file. A page of a PDF is drawn at the resolution asked for, images and lines alike. The memory needed is known from
/// the header and checked before anything of page size is allocated; a file that is too large is refused with its size,
/// the memory it needs, the memory there is, and what to do.
Result<Scan> readScan(const std::filesystem::path& path, const ScanRequest& request, const RunContext& context);

}  // namespace batten
