// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/regular_file.h"

#include <system_error>

namespace batten {
namespace {

using Problem = tl::unexpected<FileProblem>;

FileProblem openingProblem(std::error_code error) {
  if (error == std::errc::permission_denied || error == std::errc::operation_not_permitted)
    return FileProblem::NotAllowed;
  if (error == std::errc::too_many_symbolic_link_levels) return FileProblem::LinksInCircle;
  for (const std::errc missing :
       {std::errc::no_such_file_or_directory, std::errc::not_a_directory, std::errc::filename_too_long}) {
    if (error == missing) return FileProblem::Missing;
  }
  // A socket that took the name meanwhile.
  return error == std::errc::no_such_device_or_address ? FileProblem::NotOrdinary : FileProblem::Broken;
}

}  // namespace

std::string describe(FileProblem problem) {
  switch (problem) {
    case FileProblem::Missing:
      return "does not exist";
    case FileProblem::LinksInCircle:
      return "is reached by symbolic links that form a loop";
    case FileProblem::Folder:
      return "is a folder";
    case FileProblem::NotOrdinary:
      return "is not a regular file";
    case FileProblem::NotAllowed:
      return "cannot be opened: permission denied";
    case FileProblem::TooLarge:
      return "is too large";
    case FileProblem::Broken:
      break;
  }
  return "could not be read completely";
}

tl::expected<RegularFile, FileProblem> RegularFile::open(const std::filesystem::path& path) {
  auto file = ReadableFile::open(path);
  if (!file) return Problem(openingProblem(file.error()));
  if (file->kind() == FileKind::Folder) return Problem(FileProblem::Folder);
  if (file->kind() != FileKind::Ordinary) return Problem(FileProblem::NotOrdinary);
  return RegularFile(std::move(*file));
}

tl::expected<void, FileProblem> RegularFile::read(std::span<std::byte> bytes, std::uint64_t from) const {
  if (file_.read(bytes, from)) return Problem(FileProblem::Broken);
  return {};
}

tl::expected<std::string, FileProblem> readWhole(const std::filesystem::path& path, std::uint64_t mostBytes) {
  const auto file = RegularFile::open(path);
  if (!file) return Problem(file.error());
  if (file->size() > mostBytes) return Problem(FileProblem::TooLarge);
  std::string text(file->size(), '\0');
  if (const auto read = file->read(std::as_writable_bytes(std::span(text))); !read) return Problem(read.error());
  return text;
}

}  // namespace batten
