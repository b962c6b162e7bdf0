// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "core/base/platform.h"

namespace batten {

/// Why a file cannot be read as a whole.
enum class FileProblem {
  Missing,
  LinksInCircle,
  Folder,
  NotOrdinary,  ///< A pipe, a device or a socket: reading it may wait for ever or never end.
  NotAllowed,
  TooLarge,
  Broken,  ///< It opens, but its bytes do not come.
};
/// "does not exist", "is a folder" …: what follows the file's name in a message.
std::string describe(FileProblem);

/// An ordinary file, open for reading. Its type is checked on the open descriptor, not on the path, so that nothing
/// else can take the name in between; opening never waits.
class RegularFile {
 public:
  static tl::expected<RegularFile, FileProblem> open(const std::filesystem::path&);

  std::uint64_t size() const { return file_.size(); }  ///< [bytes] When it was opened.
  /// Fills `bytes` from this place of the file on. @return Broken if there are fewer.
  tl::expected<void, FileProblem> read(std::span<std::byte> bytes, std::uint64_t from = 0) const;

 private:
  explicit RegularFile(ReadableFile file) : file_(std::move(file)) {}
  ReadableFile file_;
};

/// All bytes of an ordinary file of at most `mostBytes`.
tl::expected<std::string, FileProblem> readWhole(const std::filesystem::path&, std::uint64_t mostBytes);

}  // namespace batten
