// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace batten {
namespace {

using Problem = tl::unexpected<FileProblem>;

tl::expected<void, FileProblem> ordinary(mode_t mode) {
  if (S_ISREG(mode)) return {};
  return Problem(S_ISDIR(mode) ? FileProblem::Folder : FileProblem::NotOrdinary);
}

FileProblem openingProblem(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return FileProblem::NotAllowed;
    case ENOENT:
    case ENOTDIR:
    case ELOOP:
    case ENAMETOOLONG:
      return FileProblem::Missing;
    case ENXIO:  // a socket
      return FileProblem::NotOrdinary;
    default:
      return FileProblem::Broken;
  }
}

}  // namespace

std::string describe(FileProblem problem) {
  switch (problem) {
    case FileProblem::Missing:
      return "does not exist";
    case FileProblem::Folder:
      return "is a folder";
    case FileProblem::NotOrdinary:
      return "is not an ordinary file";
    case FileProblem::NotAllowed:
      return "cannot be opened for want of permission";
    case FileProblem::TooLarge:
      return "is too large";
    case FileProblem::Broken:
      break;
  }
  return "could not be read to its end";
}

tl::expected<RegularFile, FileProblem> RegularFile::open(const std::filesystem::path& path) {
  struct stat info {};
  // Opening alone may do something to a device, rewind a tape for one: such names are left alone.
  if (::stat(path.c_str(), &info) != 0) return Problem(openingProblem(errno));
  if (const auto checked = ordinary(info.st_mode); !checked) return Problem(checked.error());
  // Should a pipe have taken the name since, this returns at once.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return Problem(openingProblem(errno));
  RegularFile file(descriptor, 0);
  if (::fstat(descriptor, &info) != 0) return Problem(FileProblem::Broken);
  if (const auto checked = ordinary(info.st_mode); !checked) return Problem(checked.error());
  file.size_ = static_cast<std::uint64_t>(info.st_size);
  return file;
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

RegularFile& RegularFile::operator=(RegularFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

tl::expected<void, FileProblem> RegularFile::read(std::span<std::byte> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return Problem(FileProblem::Broken);
    done += static_cast<std::size_t>(got);
  }
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
