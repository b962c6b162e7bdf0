// SPDX-License-Identifier: GPL-3.0-or-later
// The Windows side of platform.h and platform_memory.h. MinGW-w64 reads it (packaging/check windows); it has not been
// run on Windows by us.
#include "core/base/platform.h"

#if defined(_WIN32)

#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
// psapi.h stands on windows.h.
#include <fcntl.h>
#include <io.h>
#include <psapi.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/loaded_module.h"
#include "core/base/platform_memory.h"

namespace batten {

struct SystemFile {
  HANDLE handle;
};

void CloseSystemFile::operator()(SystemFile* file) const {
  CloseHandle(file->handle);
  delete file;
}

namespace {

namespace fs = std::filesystem;

/// What the last call says went wrong, in the words of POSIX that the callers ask for.
std::error_code systemError() {
  const DWORD error = GetLastError();
  static constexpr struct {
    DWORD windows;
    std::errc posix;
  } kMeanings[] = {
      {ERROR_FILE_NOT_FOUND, std::errc::no_such_file_or_directory},
      {ERROR_PATH_NOT_FOUND, std::errc::no_such_file_or_directory},
      {ERROR_INVALID_NAME, std::errc::no_such_file_or_directory},
      {ERROR_ACCESS_DENIED, std::errc::permission_denied},
      {ERROR_SHARING_VIOLATION, std::errc::permission_denied},
      {ERROR_FILE_EXISTS, std::errc::file_exists},
      {ERROR_ALREADY_EXISTS, std::errc::file_exists},
      {ERROR_DISK_FULL, std::errc::no_space_on_device},
      {ERROR_HANDLE_DISK_FULL, std::errc::no_space_on_device},
      {ERROR_NOT_ENOUGH_QUOTA, std::errc::no_space_on_device},
      {ERROR_WRITE_PROTECT, std::errc::read_only_file_system},
      {ERROR_FILENAME_EXCED_RANGE, std::errc::filename_too_long},
      {ERROR_TOO_MANY_OPEN_FILES, std::errc::too_many_files_open},
  };
  for (const auto& one : kMeanings) {
    if (one.windows == error) return std::make_error_code(one.posix);
  }
  return {static_cast<int>(error), std::system_category()};
}

OpenFile owned(HANDLE handle) {
  const bool isOpen = handle != INVALID_HANDLE_VALUE && handle != nullptr;
  return OpenFile(isOpen ? new SystemFile{handle} : nullptr);
}

// Others may do with the file what they like while it is open.
constexpr DWORD kShareAll = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
/// No other program may open the file meanwhile, not even to delete it: that is the lock, and it ends with the program.
constexpr DWORD kShareNothing = 0;

double secondsOf(const FILETIME& time) {
  constexpr double kTick = 1e-7;  // [s]
  return kTick * (4294967296.0 * static_cast<double>(time.dwHighDateTime) + static_cast<double>(time.dwLowDateTime));
}

}  // namespace

std::optional<std::uint64_t> availableMemoryBytes() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  if (GlobalMemoryStatusEx(&status) == 0) return std::nullopt;
  std::uint64_t available = status.ullAvailPhys;
  // A job object may allow less.
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION job{};
  if (QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &job, sizeof job, nullptr) != 0 &&
      (job.BasicLimitInformation.LimitFlags & JOB_OBJECT_LIMIT_JOB_MEMORY) != 0) {
    available = std::min<std::uint64_t>(available, job.JobMemoryLimit);
  }
  return available;
}

std::optional<std::uint64_t> peakMemoryBytes() {
  PROCESS_MEMORY_COUNTERS counters{};
  if (GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) == 0) return std::nullopt;
  return counters.PeakWorkingSetSize;
}

std::optional<std::uint64_t> residentMemoryBytes(std::int64_t processId) {
  if (processId <= 0 || processId > std::numeric_limits<DWORD>::max()) return std::nullopt;
  const OpenFile process = owned(OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(processId)));
  PROCESS_MEMORY_COUNTERS counters{};
  const bool isKnown = process && GetProcessMemoryInfo(process->handle, &counters, sizeof counters) != 0;
  return isKnown ? std::optional<std::uint64_t>(counters.WorkingSetSize) : std::nullopt;
}

void returnFreeMemory() {}

void keepFewHeaps() {}

void* allocateBuffer(std::size_t bytes) { return std::malloc(std::max<std::size_t>(1, bytes)); }

void freeBuffer(void* buffer) { std::free(buffer); }

std::optional<int> threadsWithinLimits() { return std::nullopt; }

std::string processMark(std::int64_t processId) {
  if (processId <= 0 || processId > std::numeric_limits<DWORD>::max()) return {};
  const std::string mark = std::to_string(processId);
  const OpenFile process =
      owned(OpenProcess(SYNCHRONIZE | PROCESS_QUERY_LIMITED_INFORMATION, FALSE, static_cast<DWORD>(processId)));
  if (!process) return GetLastError() == ERROR_ACCESS_DENIED ? mark : std::string();
  // An ended one has its number while it is held open.
  if (WaitForSingleObject(process->handle, 0) != WAIT_TIMEOUT) return {};
  FILETIME created, ended, kernel, user;
  if (GetProcessTimes(process->handle, &created, &ended, &kernel, &user) == 0) return mark;
  return mark + " " + std::to_string(created.dwHighDateTime) + " " + std::to_string(created.dwLowDateTime);
}

double processorSeconds() {
  FILETIME created, ended, kernel, user;
  if (GetProcessTimes(GetCurrentProcess(), &created, &ended, &kernel, &user) == 0) return 0.0;
  return secondsOf(kernel) + secondsOf(user);
}

bool stderrIsTerminal() {
  DWORD mode = 0;  // only a console has one
  return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

void reportLargeFilesAsErrors() {}  // they are errors here

void tieChildrenToThisProcess() {
  // The job is never closed by hand: the system does so when this process ends, and ends all that is left in it.
  static const HANDLE job = [] {
    const HANDLE made = CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    if (made != nullptr &&
        SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof limits) != 0)
      AssignProcessToJobObject(made, GetCurrentProcess());
    return made;
  }();
  static_cast<void>(job);
}

void becomeDependentChild() {}  // there is no such moment here

void becomeProgram(const char* const*) {}

std::optional<FileId> fileId(const fs::path& path) {
  const OpenFile file =
      owned(CreateFileW(path.c_str(), 0, kShareAll, nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  BY_HANDLE_FILE_INFORMATION info{};
  if (!file || GetFileInformationByHandle(file->handle, &info) == 0) return std::nullopt;
  return FileId{info.dwVolumeSerialNumber, (std::uint64_t{info.nFileIndexHigh} << 32) | info.nFileIndexLow};
}

bool isWritableFolder(const fs::path& path) {
  constexpr int kToWrite = 2;
  std::error_code failed;
  return fs::is_directory(path, failed) && _waccess(path.c_str(), kToWrite) == 0;
}

QuietStderr::QuietStderr() {
  std::fflush(stderr);
  const int nowhere = _open("NUL", _O_WRONLY), real = _fileno(stderr);
  if (nowhere < 0) return;
  const int kept = real < 0 ? -1 : _dup(real);
  if (kept >= 0) {
    kept_ = kept;
    _dup2(nowhere, real);
  }
  _close(nowhere);
}

QuietStderr::~QuietStderr() {
  if (!kept_) return;
  std::fflush(stderr);
  _dup2(*kept_, _fileno(stderr));
  _close(*kept_);
}

tl::expected<ReadableFile, std::error_code> ReadableFile::open(const fs::path& path) {
  const DWORD attributes = GetFileAttributesW(path.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) return tl::unexpected(systemError());
  if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) return ReadableFile(nullptr, FileKind::Folder, 0);
  OpenFile file =
      owned(CreateFileW(path.c_str(), GENERIC_READ, kShareAll, nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
  if (!file) return tl::unexpected(systemError());
  if (GetFileType(file->handle) != FILE_TYPE_DISK) return ReadableFile(nullptr, FileKind::Other, 0);
  LARGE_INTEGER size{};
  if (GetFileSizeEx(file->handle, &size) == 0) return tl::unexpected(systemError());
  return ReadableFile(std::move(file), FileKind::Ordinary, static_cast<std::uint64_t>(size.QuadPart));
}

std::error_code ReadableFile::read(std::span<std::byte> bytes, std::uint64_t from) const {
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // [bytes] One call takes no more than 32 bits hold.
  for (std::uint64_t done = 0; done < bytes.size();) {
    OVERLAPPED place{};
    place.Offset = static_cast<DWORD>((from + done) & 0xffffffffu);
    place.OffsetHigh = static_cast<DWORD>((from + done) >> 32);
    const std::size_t wanted = std::min<std::size_t>(kAtOnce, bytes.size() - done);
    DWORD got = 0;
    if (ReadFile(file_->handle, bytes.data() + done, static_cast<DWORD>(wanted), &got, &place) == 0) {
      return GetLastError() == ERROR_HANDLE_EOF ? std::make_error_code(std::errc::io_error) : systemError();
    }
    if (got == 0) return std::make_error_code(std::errc::io_error);
    done += got;
  }
  return {};
}

std::optional<std::string> nameOfOpenFile(int /*descriptor*/) { return std::nullopt; }

ReplacingFile::ReplacingFile(OpenFile folder, OpenFile file, fs::path target, std::string name)
    : folder_(std::move(folder)), file_(std::move(file)), target_(std::move(target)), name_(std::move(name)) {}

ReplacingFile::ReplacingFile(ReplacingFile&& other) noexcept
    : folder_(std::move(other.folder_)),
      file_(std::move(other.file_)),
      target_(std::move(other.target_)),
      name_(std::exchange(other.name_, {})) {}

ReplacingFile::~ReplacingFile() {
  if (name_.empty()) return;
  FILE_DISPOSITION_INFO gone{};
  gone.DeleteFile = TRUE;
  SetFileInformationByHandle(file_->handle, FileDispositionInfo, &gone, sizeof gone);
}

tl::expected<ReplacingFile, std::error_code> ReplacingFile::create(const fs::path& target, const std::string& name) {
  std::error_code code;
  const fs::path whole = fs::absolute(target, code);
  if (code) return tl::unexpected(code);
  // Held open without leave to delete it, the folder cannot be renamed meanwhile.
  OpenFile folder =
      owned(CreateFileW(whole.parent_path().c_str(), FILE_LIST_DIRECTORY, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                        OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  if (!folder) return tl::unexpected(systemError());
  const DWORD before = GetFileAttributesW(whole.c_str());
  if (before != INVALID_FILE_ATTRIBUTES && (before & FILE_ATTRIBUTE_READONLY) != 0)
    return tl::unexpected(std::make_error_code(std::errc::permission_denied));
  OpenFile file = owned(CreateFileW((whole.parent_path() / name).c_str(), GENERIC_WRITE | DELETE, kShareNothing,
                                    nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
  if (!file) return tl::unexpected(systemError());
  return ReplacingFile(std::move(folder), std::move(file), whole, name);
}

std::error_code ReplacingFile::write(std::string_view bytes) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 30;  // [bytes]
  while (!bytes.empty()) {
    DWORD count = 0;
    if (WriteFile(file_->handle, bytes.data(), static_cast<DWORD>(std::min(kAtOnce, bytes.size())), &count, nullptr) ==
        0)
      return systemError();
    bytes.remove_prefix(count);
  }
  return {};
}

tl::expected<OpenFile, std::error_code> ReplacingFile::takePlace() {
  if (FlushFileBuffers(file_->handle) == 0) return tl::unexpected(systemError());
  const std::wstring name = target_.native();
  std::vector<std::byte> memory(sizeof(FILE_RENAME_INFO) + name.size() * sizeof(wchar_t));
  auto* const info = new (memory.data()) FILE_RENAME_INFO{};
  info->ReplaceIfExists = TRUE;
  info->FileNameLength = static_cast<DWORD>(name.size() * sizeof(wchar_t));
  std::memcpy(info->FileName, name.data(), info->FileNameLength);
  if (SetFileInformationByHandle(file_->handle, FileRenameInfo, info, static_cast<DWORD>(memory.size())) == 0)
    return tl::unexpected(systemError());
  name_.clear();
  file_.reset();  // it shares the file with nobody
  return takeAlone(target_);
}

OpenFile takeAlone(const fs::path& path) {
  OpenFile file = owned(CreateFileW(path.c_str(), GENERIC_READ, kShareAll, nullptr, OPEN_EXISTING,
                                    FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
  // A byte far behind the end is locked: the file itself stays free.
  OVERLAPPED at{};
  at.OffsetHigh = 0x40000000;
  const bool isTaken =
      file && LockFileEx(file->handle, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &at) != 0;
  return isTaken ? std::move(file) : nullptr;
}

void removeLeftover(const fs::path& path) {
  const DWORD attributes = GetFileAttributesW(path.c_str());
  // No ordinary files: what is there is not ours.
  constexpr DWORD kForeign = FILE_ATTRIBUTE_DIRECTORY | FILE_ATTRIBUTE_REPARSE_POINT | FILE_ATTRIBUTE_DEVICE;
  if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & kForeign) != 0) return;
  DeleteFileW(path.c_str());  // fails while a program writes it
}

tl::expected<SharedLines, std::error_code> SharedLines::open(const fs::path& path) {
  OpenFile file = owned(CreateFileW(path.c_str(), GENERIC_READ | GENERIC_WRITE, kShareAll, nullptr, OPEN_ALWAYS,
                                    FILE_ATTRIBUTE_NORMAL, nullptr));
  if (!file) return tl::unexpected(systemError());
  const bool isOnDisk = GetFileType(file->handle) == FILE_TYPE_DISK;
  return SharedLines(std::move(file), isOnDisk ? FileKind::Ordinary : FileKind::Other);
}

std::uint64_t SharedLines::size() const {
  LARGE_INTEGER size{};
  const bool isKnown = kind_ == FileKind::Ordinary && GetFileSizeEx(file_->handle, &size) != 0;
  return isKnown ? static_cast<std::uint64_t>(size.QuadPart) : 0;
}

tl::expected<std::string, std::error_code> SharedLines::read(std::uint64_t offset, std::size_t most) const {
  std::string text;
  if (kind_ != FileKind::Ordinary) return text;
  text.resize(most);
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(offset & 0xffffffffu);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32);
  DWORD got = 0;
  if (ReadFile(file_->handle, text.data(), static_cast<DWORD>(most), &got, &place) == 0 &&
      GetLastError() != ERROR_HANDLE_EOF)
    return tl::unexpected(systemError());
  text.resize(got);
  return text;
}

std::error_code SharedLines::add(std::string_view text) {
  const bool isOrdinary = kind_ == FileKind::Ordinary;
  OVERLAPPED guard{};  // a byte far behind every end: what is there may be read meanwhile
  guard.OffsetHigh = 0x40000000;
  if (isOrdinary) LockFileEx(file_->handle, LOCKFILE_EXCLUSIVE_LOCK, 0, 1, 0, &guard);
  const std::uint64_t before = size();
  std::string whole;
  if (before > 0) {
    const auto last = read(before - 1, 1);
    if (last && *last != "\n") whole = "\n";
  }
  whole += text;
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(before & 0xffffffffu);
  place.OffsetHigh = static_cast<DWORD>(before >> 32);
  DWORD count = 0;
  std::error_code error;
  if (WriteFile(file_->handle, whole.data(), static_cast<DWORD>(whole.size()), &count, isOrdinary ? &place : nullptr) ==
      0) {
    error = systemError();
    LARGE_INTEGER end{};
    end.QuadPart = static_cast<LONGLONG>(before);
    if (isOrdinary && SetFilePointerEx(file_->handle, end, nullptr, FILE_BEGIN) != 0) SetEndOfFile(file_->handle);
  }
  if (isOrdinary) UnlockFileEx(file_->handle, 0, 1, 0, &guard);
  return error;
}

LockFile::LockFile(fs::path path) : path_(std::move(path)) {}

LockFile::~LockFile() { release(); }

LockState LockFile::tryHold() {
  if (file_) {  // nobody can remove it meanwhile
    FILETIME now{};
    GetSystemTimeAsFileTime(&now);
    SetFileTime(file_->handle, nullptr, nullptr, &now);
    return LockState::Held;
  }
  file_ = owned(CreateFileW(path_.c_str(), GENERIC_READ | GENERIC_WRITE | DELETE, kShareNothing, nullptr, OPEN_ALWAYS,
                            FILE_FLAG_DELETE_ON_CLOSE | FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
  if (file_) return LockState::Held;
  return GetLastError() == ERROR_SHARING_VIOLATION ? LockState::Busy : LockState::Impossible;
}

void LockFile::release() { file_.reset(); }

void* functionOfModule(const std::string& module, const char* function) {
  // Windows looks beside the program first, where this file lies.
  const HMODULE loaded = ::LoadLibraryA((module + ".dll").c_str());
  return loaded != nullptr ? reinterpret_cast<void*>(::GetProcAddress(loaded, function)) : nullptr;
}

}  // namespace batten

#endif
