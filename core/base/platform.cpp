// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/platform.h"

#if !defined(_WIN32)

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "core/base/loaded_module.h"

namespace batten {

std::optional<int> threadsWithinLimits() {
  // What a thread takes of it: its stack, and the region from which the C library hands out memory to it.
  constexpr rlim_t kUsualStack = rlim_t{8} << 20, kRegion = rlim_t{64} << 20;
  constexpr rlim_t kLeftToWork = 4;  // one part of so many goes to threads
  rlimit all{}, stack{};
  if (getrlimit(RLIMIT_AS, &all) != 0 || all.rlim_cur == RLIM_INFINITY) return std::nullopt;
  const bool isKnown = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
  const rlim_t each = (isKnown ? stack.rlim_cur : kUsualStack) + kRegion;
  return static_cast<int>(std::min<rlim_t>(all.rlim_cur / kLeftToWork / each, std::numeric_limits<int>::max()));
}

std::string processMark(std::int64_t processId) {
  const bool exists = processId > 0 && (::kill(static_cast<pid_t>(processId), 0) == 0 || errno == EPERM);
  if (!exists) return {};
  std::string mark = std::to_string(processId);
#if defined(__linux__)
  constexpr int kFieldsToStart = 19;  // from the state to the time at which it began (proc(5), fields 3 and 22)
  std::ifstream file("/proc/" + mark + "/stat"), bootFile("/proc/sys/kernel/random/boot_id");
  std::string line, state, word, boot;
  std::getline(file, line);
  const auto name = line.rfind(')');  // the program's name may hold anything, also brackets
  if (name == std::string::npos) return mark;
  std::istringstream fields(line.substr(name + 1));
  fields >> state;
  if (state == "Z" || state == "X") return {};
  for (int i = 0; i < kFieldsToStart; ++i) fields >> word;
  bootFile >> boot;
  mark += " " + word + " " + boot;
#endif
  return mark;
}

bool stderrIsTerminal() { return isatty(STDERR_FILENO) == 1; }

void reportLargeFilesAsErrors() { std::signal(SIGXFSZ, SIG_IGN); }

void tieChildrenToThisProcess() {}  // each ties itself

void becomeDependentChild() {
  // What is sent to the whole group, from the terminal or by a queue that ends a job, is the parent's to hear. Kept
  // over exec.
  for (const int one : {SIGINT, SIGTERM, SIGHUP}) std::signal(one, SIG_IGN);
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

void becomeProgram(const char* const* words) { ::execv(words[0], const_cast<char* const*>(words)); }

std::optional<FileId> fileId(const std::filesystem::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return std::nullopt;
  return FileId{static_cast<std::uint64_t>(info.st_dev), static_cast<std::uint64_t>(info.st_ino)};
}

bool isWritableFolder(const std::filesystem::path& path) {
  std::error_code failed;
  return std::filesystem::is_directory(path, failed) && ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0;
}

QuietStderr::QuietStderr() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  std::fflush(stderr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  const int kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept >= 0) {
    kept_ = kept;
    dup2(nowhere, STDERR_FILENO);
  }
  close(nowhere);
#endif
}

QuietStderr::~QuietStderr() {
  if (!kept_) return;
  std::fflush(stderr);
  dup2(*kept_, STDERR_FILENO);
  close(*kept_);
}

struct SystemFile {
  int descriptor;
};

void CloseSystemFile::operator()(SystemFile* file) const {
  ::close(file->descriptor);
  delete file;
}

namespace {

std::error_code systemError() {
  if (errno == EDQUOT) return std::make_error_code(std::errc::no_space_on_device);
  return {errno, std::generic_category()};
}

/// Takes what open() gave; null where it failed, which errno tells.
OpenFile owned(int descriptor) { return OpenFile(descriptor < 0 ? nullptr : new SystemFile{descriptor}); }

FileKind kindOf(mode_t mode) {
  if (S_ISREG(mode)) return FileKind::Ordinary;
  return S_ISDIR(mode) ? FileKind::Folder : FileKind::Other;
}

/// Whether the path, no link, still names the open file.
bool isNamed(const SystemFile& file, const std::filesystem::path& path) {
  struct stat held {
  }, named{};
  return ::fstat(file.descriptor, &held) == 0 && ::lstat(path.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

#if defined(__linux__)
constexpr int kFolderForNames = O_PATH | O_DIRECTORY | O_CLOEXEC;  // one that may be searched, but not listed, will do
#else
constexpr int kFolderForNames = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
#endif

std::error_code reachDisk(int descriptor) {
#if defined(__APPLE__)
  const bool isSafe = ::fsync(descriptor) == 0;
#else
  const bool isSafe = ::fdatasync(descriptor) == 0;
#endif
  // Some file systems know no such call: they say so, and that is no failure.
  return isSafe || errno == EINVAL || errno == ENOSYS || errno == EROFS ? std::error_code() : systemError();
}

}  // namespace

tl::expected<ReadableFile, std::error_code> ReadableFile::open(const std::filesystem::path& path) {
  struct stat info {};
  // Opening alone may do something to a device, rewind a tape for one: such names are left alone.
  if (::stat(path.c_str(), &info) != 0) return tl::unexpected(systemError());
  if (kindOf(info.st_mode) != FileKind::Ordinary) return ReadableFile(nullptr, kindOf(info.st_mode), 0);
  // Should a pipe have taken the name since, this returns at once.
  OpenFile file = owned(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!file || ::fstat(file->descriptor, &info) != 0) return tl::unexpected(systemError());
  if (kindOf(info.st_mode) != FileKind::Ordinary) return ReadableFile(nullptr, kindOf(info.st_mode), 0);
  return ReadableFile(std::move(file), FileKind::Ordinary, static_cast<std::uint64_t>(info.st_size));
}

std::error_code ReadableFile::read(std::span<std::byte> bytes, std::uint64_t from) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(file_->descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(from + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return systemError();
    if (got == 0) return std::make_error_code(std::errc::io_error);
    done += got;
  }
  return {};
}

std::optional<std::string> nameOfOpenFile(int descriptor) {
#if defined(__linux__)
  std::string name = "/proc/self/fd/" + std::to_string(descriptor);
  struct stat info {};
  if (descriptor >= 0 && ::stat(name.c_str(), &info) == 0) return name;
#endif
  return std::nullopt;
}

ReplacingFile::ReplacingFile(OpenFile folder, OpenFile file, std::filesystem::path target, std::string name)
    : folder_(std::move(folder)), file_(std::move(file)), target_(std::move(target)), name_(std::move(name)) {}

ReplacingFile::ReplacingFile(ReplacingFile&& other) noexcept
    : folder_(std::move(other.folder_)),
      file_(std::move(other.file_)),
      target_(std::move(other.target_)),
      name_(std::exchange(other.name_, {})) {}

ReplacingFile::~ReplacingFile() {
  if (!name_.empty()) ::unlinkat(folder_->descriptor, name_.c_str(), 0);
}

tl::expected<ReplacingFile, std::error_code> ReplacingFile::create(const std::filesystem::path& target,
                                                                   const std::string& name) {
  const auto failed = [] { return tl::unexpected(systemError()); };
  const std::filesystem::path parent = target.has_parent_path() ? target.parent_path() : ".";
  OpenFile folder = owned(::open(parent.c_str(), kFolderForNames));
  if (!folder) return failed();
  const std::string last = target.filename().native();
  struct stat before {};
  const bool replaces = ::fstatat(folder->descriptor, last.c_str(), &before, 0) == 0;
  // A file that may not be written is not replaced either, though its folder would allow it.
  if (replaces && ::faccessat(folder->descriptor, last.c_str(), W_OK, AT_EACCESS) != 0) return failed();
  constexpr int kFresh = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;  // only as a new file
  OpenFile file = owned(::openat(folder->descriptor, name.c_str(), kFresh, 0666));
  if (!file) return failed();
  // Between these two calls another program may have taken the file for a leftover.
  const bool isHeld = ::flock(file->descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  struct stat now {};
  if (!isHeld || ::fstat(file->descriptor, &now) != 0 || now.st_nlink == 0)
    return tl::unexpected(std::make_error_code(std::errc::file_exists));
  if (replaces) (void)::fchmod(file->descriptor, before.st_mode & 0777);  // foreign disks know no such bits
  return ReplacingFile(std::move(folder), std::move(file), target, name);
}

std::error_code ReplacingFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_->descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return systemError();
    bytes.remove_prefix(count);
  }
  return {};
}

tl::expected<OpenFile, std::error_code> ReplacingFile::takePlace() {
  // A disk that is told of the name before it has the bytes leaves an empty file where a whole one was, should the
  // power fail.
  if (const auto error = reachDisk(file_->descriptor)) return tl::unexpected(error);
  const std::string last = target_.filename().native();
  if (::renameat(folder_->descriptor, name_.c_str(), folder_->descriptor, last.c_str()) != 0)
    return tl::unexpected(systemError());
  name_.clear();
  return std::move(file_);
}

OpenFile takeAlone(const std::filesystem::path& path) {
  constexpr int kAsItIs = O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC;
  // NFS locks alone only what may be written.
  OpenFile file = owned(::open(path.c_str(), O_RDWR | kAsItIs));
  if (!file) file = owned(::open(path.c_str(), O_RDONLY | kAsItIs));
  struct stat info {};
  if (!file || ::fstat(file->descriptor, &info) != 0 || !S_ISREG(info.st_mode)) return nullptr;
  // On a disk without locks it is nobody's.
  if (::flock(file->descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return nullptr;
  // Its holder may have replaced it between the two calls: then this is a lock on nothing.
  return isNamed(*file, path) ? std::move(file) : nullptr;
}

void removeLeftover(const std::filesystem::path& path) {
  const OpenFile file = owned(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
  struct stat info {};
  if (!file || ::fstat(file->descriptor, &info) != 0 || !S_ISREG(info.st_mode) || info.st_uid != ::geteuid()) return;
  // Whoever saves holds a lock on its file, which ends with its program, so that a free one has no owner.
  if (::flock(file->descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
}

tl::expected<SharedLines, std::error_code> SharedLines::open(const std::filesystem::path& path) {
  struct stat info {};
  const bool isOther = ::stat(path.c_str(), &info) == 0 && kindOf(info.st_mode) != FileKind::Ordinary;
  constexpr int kAdding = O_APPEND | O_CLOEXEC | O_NOCTTY;
  // A pipe that nobody reads is refused, not waited for.
  constexpr int kAddingElsewhere = O_WRONLY | O_NONBLOCK | kAdding;
  OpenFile file = owned(::open(path.c_str(), isOther ? kAddingElsewhere : O_RDWR | O_CREAT | kAdding, 0666));
  if (!file || ::fstat(file->descriptor, &info) != 0) return tl::unexpected(systemError());
  if (isOther && ::fcntl(file->descriptor, F_SETFL, kAddingElsewhere & ~O_NONBLOCK) != 0)
    return tl::unexpected(systemError());
  return SharedLines(std::move(file), kindOf(info.st_mode));
}

std::uint64_t SharedLines::size() const {
  struct stat info {};
  const bool isKnown = kind_ == FileKind::Ordinary && ::fstat(file_->descriptor, &info) == 0;
  return isKnown ? static_cast<std::uint64_t>(info.st_size) : 0;
}

tl::expected<std::string, std::error_code> SharedLines::read(std::uint64_t offset, std::size_t most) const {
  std::string text;
  if (kind_ != FileKind::Ordinary) return text;
  text.resize(most);
  std::size_t done = 0;
  while (done < most) {
    const ssize_t got = ::pread(file_->descriptor, text.data() + done, most - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return tl::unexpected(systemError());
    if (got == 0) break;
    done += got;
  }
  text.resize(done);
  return text;
}

std::error_code SharedLines::add(std::string_view text) {
  const bool isOrdinary = kind_ == FileKind::Ordinary;
  // A disk without locks takes the text in one piece all the same.
  while (isOrdinary && ::flock(file_->descriptor, LOCK_EX) != 0 && errno == EINTR) continue;
  const std::uint64_t before = size();
  bool isCut = false;  // its last line, by a full disk
  if (before > 0) {
    const auto last = read(before - 1, 1);
    isCut = last && !last->ends_with('\n');
  }
  std::string whole;
  whole.reserve(text.size() + 1);
  if (isCut) whole.push_back('\n');
  whole.append(text);
  std::error_code error;
  for (std::string_view left = whole; !left.empty() && !error;) {
    const ssize_t count = ::write(file_->descriptor, left.data(), left.size());
    if (count >= 0) left.remove_prefix(count);
    if (count < 0 && errno != EINTR) error = systemError();
  }
  if (isOrdinary && error && ::ftruncate(file_->descriptor, static_cast<off_t>(before)) != 0) error = systemError();
  if (isOrdinary) ::flock(file_->descriptor, LOCK_UN);
  return error;
}

LockFile::LockFile(std::filesystem::path path) : path_(std::move(path)) {}

LockFile::~LockFile() { release(); }

LockState LockFile::tryHold() {
  if (file_ && isNamed(*file_, path_)) {
    (void)::futimens(file_->descriptor, nullptr);  // What looks unused for days is cleaned away on some machines.
    return LockState::Held;
  }
  release();
  // A lock that is deleted between opening and locking it is taken anew, so many times.
  constexpr int kFlags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kAttempts = 10;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    OpenFile file = owned(::open(path_.c_str(), O_RDWR | O_CREAT | kFlags, 0644));
    if (!file && errno == EACCES) file = owned(::open(path_.c_str(), O_RDONLY | kFlags));  // another user's
    if (!file) return LockState::Impossible;
    if (::flock(file->descriptor, LOCK_EX | LOCK_NB) != 0)
      return errno == EWOULDBLOCK ? LockState::Busy : LockState::Impossible;
    // Its last holder may have removed the file between the two calls: then this is a lock on nothing.
    if (!isNamed(*file, path_)) continue;
    file_ = std::move(file);
    return LockState::Held;
  }
  return LockState::Busy;
}

void LockFile::release() {
  if (file_ && isNamed(*file_, path_)) ::unlink(path_.c_str());
  file_.reset();
}

void* functionOfModule(const std::string& module, const char* function) {
  // Found by the run path of the program, in which this file lies; macOS looks there only if it is told to.
#ifdef __APPLE__
  const std::string name = "@rpath/lib" + module + ".so";
#else
  const std::string name = "lib" + module + ".so";
#endif
  void* loaded = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
  return loaded != nullptr ? ::dlsym(loaded, function) : nullptr;
}

}  // namespace batten

#endif
