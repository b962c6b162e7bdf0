// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/regular_file.h"
#include "core/base/result.h"

namespace batten {

/// UnreadableScan: `what` follows the file's name in the message.
tl::unexpected<Error> unreadable(const std::filesystem::path& path, const std::string& what, std::string detail = {});

/// An ordinary file that is not empty. @return UnreadableScan with what to do.
Result<RegularFile> openedScan(const std::filesystem::path& path);
/// Its first `count` bytes. @return UnreadableScan with what to do.
Result<std::vector<std::byte>> readBytes(const std::filesystem::path& path, const RegularFile&, std::uint64_t count);

/// What it says where a file has no page of that number.
Error noSuchPage(const std::filesystem::path& path, int page, int pages);

/// What reading a picture takes.
struct ReadingCost {
  int widthPx = 0, heightPx = 0;
  std::uint64_t memoryBytes = 0;  ///< At its peak.
  std::uint64_t fileBytes = 0;    ///< Size of the file.
};
/// Why a picture is too large to be read, with what to do.
/// @param memoryBytes that reading may take; absent means what the machine has free.
std::optional<Error> checkCost(const std::filesystem::path& path, const ReadingCost&,
                               std::optional<std::uint64_t> memoryBytes, const std::string& whatToDo);

inline constexpr std::uint64_t kLargestScanBytes = INT32_MAX;  ///< The decoder counts bytes by int.

}  // namespace batten
