// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/base/regular_file.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/scan.h"

namespace batten {

/// Whether a file begins as a PDF does.
bool isPdf(const RegularFile&);

/// The size of a page in the pixels that it is drawn with. @return UnreadableScan with what to do if the file is
/// damaged or locked, has no such page, or this build reads no PDF.
Result<ScanInfo> probePdf(const std::filesystem::path& path, const RegularFile&, const PageChoice&);

/// 1 where that cannot be known.
int countPdfPages(const std::filesystem::path& path, const RegularFile&);

struct PdfRequest {
  PageChoice page;
  std::optional<std::uint64_t> memoryBytes;  ///< [bytes] that reading may take; absent: what the machine has free.
};
/// A page drawn as a scan of the resolution asked for. @return UnreadableScan as probePdf, or if it is too large.
Result<Scan> readPdfScan(const std::filesystem::path& path, const RegularFile&, const PdfRequest&, const RunContext&);

}  // namespace batten
