// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/save_atomically.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <random>
#include <system_error>
#include <utility>

#include "core/base/shown_text.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

/// Links that lead to one another in more steps than the system follows lead in a circle.
constexpr int kMostLinks = 40;

constexpr std::string_view kPrefix = ".batten-", kSuffix = ".saving";
constexpr std::size_t kDigits = 16;

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& why, std::string detail = {}) {
  return fail(ErrorCode::CannotWrite, "Cannot write " + shownName(path) + ": " + why, std::move(detail));
}

std::string reason(int systemError) {
  switch (systemError) {
    case ENOSPC:
    case EDQUOT:
      return "the disk is full. Free some space or choose another place.";
    case EFBIG:
      return "the file would become larger than is allowed here. Choose another place.";
    case EACCES:
    case EPERM:
      return "there is no permission to write there. Choose another place.";
    case EROFS:
      return "the disk is write-protected. Choose another place.";
    case ENAMETOOLONG:
      return "the name is too long. Choose a shorter one.";
    case EMFILE:
    case ENFILE:
      return "too many files are open. Close other programs and try again.";
    default:
      return "the disk or its connection failed. Choose another place.";
  }
}

tl::unexpected<Error> failedCall(const fs::path& path, int systemError) {
  return cannotWrite(path, reason(systemError), std::generic_category().message(systemError));
}

/// What stands in the way before anything is written; nullopt if nothing is known to.
std::optional<std::string> obstacle(const fs::path& path) {
  std::error_code code;
  if (path.empty() || path.filename().empty()) return "the file has no name. Add a file name.";
  if (fs::is_directory(path, code)) return "it is a folder. Add a file name.";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::exists(folder, code))
    return "the folder " + shownName(folder) + " does not exist. Create it or choose another.";
  if (!fs::is_directory(folder, code)) return shownName(folder) + " is not a folder. Choose another place.";
  if (fs::exists(path, code) && !fs::is_regular_file(path, code))
    return "it is not an ordinary file. Choose another name.";
  return std::nullopt;
}

/// An open file or folder, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int get() const { return number_; }
  bool isOpen() const { return number_ >= 0; }

 private:
  int number_;
};

/// A name for a file that is being written, and whether a name is one: short, whatever the target is called.
std::string savingName() {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::random_device random;
  std::string name(kPrefix);
  for (std::size_t i = 0; i < kDigits; ++i) name.push_back(kHex[random() & 0xfu]);
  return name.append(kSuffix);
}

bool isSavingName(std::string_view name) {
  return name.size() == kPrefix.size() + kDigits + kSuffix.size() && name.starts_with(kPrefix) &&
         name.ends_with(kSuffix) &&
         name.substr(kPrefix.size(), kDigits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Removes what programs left in the folder that were ended while they saved. Whoever saves holds a lock on its file,
/// which ends with its program, so that a free one has no owner. What cannot be removed stays.
void removeLeftovers(const fs::path& folder) {
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    const fs::path& path = entry->path();
    if (!isSavingName(path.filename().native())) continue;
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
    struct stat info {};
    if (!file.isOpen() || ::fstat(file.get(), &info) != 0 || !S_ISREG(info.st_mode) || info.st_uid != ::geteuid())
      continue;
    if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
  }
}

/// The file that becomes the target once it is whole; gone with this object unless it did.
class Saving {
 public:
  explicit Saving(const fs::path& target)
      : target_(target),
        folder_(
            ::open(target.has_parent_path() ? target.parent_path().c_str() : ".", O_PATH | O_DIRECTORY | O_CLOEXEC)) {}
  Saving(const Saving&) = delete;
  Saving& operator=(const Saving&) = delete;
  ~Saving() {
    if (!name_.empty()) ::unlinkat(folder_.get(), name_.c_str(), 0);
  }

  /// Each returns 0 or the system's error.
  int write(std::string_view bytes) {
    if (const int error = create(); error != 0) return error;
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_->get(), bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return errno;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    // A disk that is told of the name before it has the bytes leaves an empty file where a whole one was, should the
    // power fail. Some file systems know no such call: they say so, and that is no failure.
    const bool isSafe = ::fdatasync(file_->get()) == 0 || errno == EINVAL || errno == ENOSYS || errno == EROFS;
    return isSafe ? 0 : errno;
  }
  int rename() {
    if (::renameat(folder_.get(), name_.c_str(), folder_.get(), target_.filename().c_str()) != 0) return errno;
    name_.clear();
    return 0;
  }

 private:
  int create() {
    if (!folder_.isOpen()) return errno;
    struct stat before {};
    const bool replaces = ::fstatat(folder_.get(), target_.filename().c_str(), &before, 0) == 0;
    // A file that may not be written is not replaced either, though its folder would allow it.
    if (replaces && ::faccessat(folder_.get(), target_.filename().c_str(), W_OK, AT_EACCESS) != 0) return errno;
    constexpr int kAttempts = 100;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      std::string name = savingName();
      const int number =
          ::openat(folder_.get(), name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (number < 0 && errno == EEXIST) continue;
      if (number < 0) return errno;
      Descriptor file(number);
      // Between these two calls another program may have taken the file for a leftover.
      const bool isHeld = ::flock(number, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
      struct stat now {};
      if (!isHeld || ::fstat(number, &now) != 0 || now.st_nlink == 0) continue;
      name_ = std::move(name);
      file_.emplace(std::move(file));
      if (replaces) (void)::fchmod(number, before.st_mode & 0777);  // foreign disks know no such bits
      return 0;
    }
    return EBUSY;
  }

  fs::path target_;
  Descriptor folder_;
  std::optional<Descriptor> file_;
  std::string name_;
};

}  // namespace

std::optional<fs::path> saveTarget(const fs::path& path) {
  fs::path target = path;
  std::error_code code;
  for (int i = 0; i < kMostLinks; ++i) {
    if (!fs::is_symlink(fs::symlink_status(target, code))) return target;
    const fs::path next = fs::read_symlink(target, code);
    if (code) return target;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return std::nullopt;
}

Result<void> saveAtomically(const fs::path& path, std::string_view bytes) {
  const auto target = saveTarget(path);
  if (!target) return cannotWrite(path, "its links lead in a circle. Choose another name.");
  if (const auto why = obstacle(*target)) return cannotWrite(path, *why);
  removeLeftovers(target->has_parent_path() ? target->parent_path() : fs::path("."));
  Saving saving(*target);
  if (const int error = saving.write(bytes); error != 0) return failedCall(path, error);
  if (const int error = saving.rename(); error != 0) return failedCall(path, error);
  return {};
}

}  // namespace batten
