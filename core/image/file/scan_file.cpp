// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/file/scan_file.h"

#include "core/base/platform_memory.h"
#include "core/base/shown_text.h"

namespace batten {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;  // the decoder's own limit
constexpr double kShareOfFreeMemory = 0.8;                     // the later stages need some too

tl::unexpected<Error> problemOf(const std::filesystem::path& path, FileProblem problem) {
  switch (problem) {
    case FileProblem::Missing:
      return unreadable(path, "does not exist; check the path.");
    case FileProblem::LinksInCircle:
      return unreadable(path, "is reached by symbolic links that form a loop; check the links.");
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
  return unreadable(path, "could not be read completely; copy it again.");
}

/// With two digits behind the point, whatever the locale.
std::string gigabytes(std::uint64_t bytes) {
  constexpr std::uint64_t kHundredth = 10'000'000;  // of a gigabyte
  const std::uint64_t hundredths = (bytes + kHundredth / 2) / kHundredth;
  const std::string digits = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + (digits.size() == 1 ? ".0" : ".") + digits + " GB";
}

}  // namespace

tl::unexpected<Error> unreadable(const std::filesystem::path& path, const std::string& what, std::string detail) {
  std::string message(1, '"');
  message.append(shownName(path)).append("\" ").append(what);
  return fail(ErrorCode::UnreadableScan, std::move(message), std::move(detail));
}

Result<RegularFile> openedScan(const std::filesystem::path& path) {
  auto file = RegularFile::open(path);
  if (!file) return problemOf(path, file.error());
  if (file->size() == 0) return unreadable(path, "is empty (0 bytes); scan or copy it again.");
  return std::move(*file);
}

Result<std::vector<std::byte>> readBytes(const std::filesystem::path& path, const RegularFile& file,
                                         std::uint64_t count) {
  std::vector<std::byte> bytes(count);
  if (const auto read = file.read(bytes); !read) return problemOf(path, read.error());
  return bytes;
}

Error noSuchPage(const std::filesystem::path& path, int page, int pages) {
  const std::string has = pages == 1 ? "one page only" : std::to_string(pages) + " pages";
  return unreadable(path, "has " + has + ": there is no page " + std::to_string(page) + ".").value();
}

std::optional<Error> checkCost(const std::filesystem::path& path, const ReadingCost& cost,
                               std::optional<std::uint64_t> memoryBytes, const std::string& whatToDo) {
  const std::string size = std::to_string(cost.widthPx) + " x " + std::to_string(cost.heightPx) + " px";
  const std::uint64_t pixels = static_cast<std::uint64_t>(cost.widthPx) * static_cast<std::uint64_t>(cost.heightPx);
  std::optional<std::uint64_t> available = memoryBytes;
  if (!available) {
    if (const auto free = availableMemoryBytes()) {
      available = static_cast<std::uint64_t>(kShareOfFreeMemory * static_cast<double>(*free));
    }
  }
  if (available && cost.memoryBytes > *available) {
    return unreadable(path, "is too large: " + size + " need " + gigabytes(cost.memoryBytes) + " of memory, " +
                                gigabytes(*available) + " are free. " + whatToDo)
        .value();
  }
  if (pixels > kMostPixels || cost.fileBytes > kLargestScanBytes) {
    return unreadable(path, "is too large: " + size + " (" + gigabytes(cost.fileBytes) +
                                " file) is more than can be read. " + whatToDo)
        .value();
  }
  return std::nullopt;
}

}  // namespace batten
