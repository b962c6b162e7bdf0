// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/save_atomically.h"

#include <chrono>

#include "core/base/content_hash.h"
#include "core/base/shown_text.h"

namespace batten {
namespace {

namespace fs = std::filesystem;

/// Links that lead to one another in more steps than the system follows lead in a circle.
constexpr int kMostLinks = 40;

// of the file that is written before it takes the name
constexpr std::string_view kPrefix = ".batten-", kSuffix = ".saving";
constexpr std::size_t kDigits = 16;  // of its name

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& why, std::string detail = {}) {
  return fail(ErrorCode::CannotWrite, "Cannot write " + shownName(path) + ": " + why, std::move(detail));
}

tl::unexpected<Error> failedCall(const fs::path& path, std::error_code error) {
  return cannotWrite(path, whyNotWritten(error), error.message());
}

/// What stands in the way before anything is written; nullopt if nothing is known to.
std::optional<std::string> obstacle(const fs::path& path) {
  std::error_code code;
  if (path.empty() || path.filename().empty()) return "the file has no name. Add a file name.";
  if (fs::is_directory(path, code)) return "it is a folder. Add a file name.";
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const bool isThere = fs::exists(folder, code);
  if (code == std::errc::too_many_symbolic_link_levels)
    return "the symbolic links of its folder form a loop. Choose another folder.";
  if (!isThere) return "the folder " + shownName(folder) + " does not exist. Create it or choose another.";
  if (!fs::is_directory(folder, code)) return shownName(folder) + " is not a folder. Choose another place.";
  if (fs::exists(path, code) && !fs::is_regular_file(path, code))
    return "it is not a regular file. Choose another name.";
  return std::nullopt;
}

/// The name of a file that is being written for `target`: short, whatever the target is called, and always the same, so
/// that what was left of an earlier attempt is found without a look through the folder.
std::string savingName(const fs::path& target, int attempt) {
  HashBuilder hash;
  hash.text(target.filename().string()).integer(attempt);
  return std::string(kPrefix).append(hash.finish().hex(), 0, kDigits).append(kSuffix);
}

fs::path folderOf(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

/// Programs that save one target at the same time take these names one after another. More than a few never do.
constexpr int kNamesInUse = 4;

/// Removes what programs left in the folder that were ended while they saved any file. Not what is newer than a day: on
/// a disk whose locks other machines do not see, one of them may be saving it.
void removeLeftoversIn(const fs::path& folder) {
  constexpr int kMostNames = 1000;  // that are looked at: a folder of an archive may have a million
  constexpr auto kLeastAge = std::chrono::hours(24);
  const fs::file_time_type newest = fs::file_time_type::clock::now() - kLeastAge;
  std::error_code code;
  int names = 0;
  for (fs::directory_iterator one(folder, code), end; !code && one != end && names < kMostNames; one.increment(code)) {
    ++names;
    const std::string name = one->path().filename().string();
    if (name.size() == kPrefix.size() + kDigits + kSuffix.size() && name.starts_with(kPrefix) &&
        name.ends_with(kSuffix) && fs::last_write_time(one->path(), code) < newest && !code)
      removeLeftover(one->path());
  }
}

/// An empty file beside the target, under a name that nothing has.
tl::expected<ReplacingFile, std::error_code> fileBeside(const fs::path& target) {
  constexpr int kAttempts = 100;  // at a name that is free
  std::error_code error;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    auto file = ReplacingFile::create(target, savingName(target, attempt));
    if (file) return file;
    error = file.error();
    if (error != std::errc::file_exists) break;
  }
  return tl::unexpected(error);
}

}  // namespace

std::string whyNotWritten(std::error_code error) {
  static constexpr struct {
    std::errc cause;
    const char* words;
  } kReasons[] = {
      {std::errc::no_space_on_device, "the disk is full. Free some space or choose another place."},
      {std::errc::file_too_large, "the file would exceed the file size limit. Choose another place."},
      {std::errc::permission_denied, "there is no permission to write there. Choose another place."},
      {std::errc::operation_not_permitted, "there is no permission to write there. Choose another place."},
      {std::errc::read_only_file_system, "the disk is write-protected. Choose another place."},
      {std::errc::filename_too_long, "the name is too long. Choose a shorter one."},
      {std::errc::too_many_files_open, "too many files are open. Close other programs and try again."},
      {std::errc::too_many_files_open_in_system, "too many files are open. Close other programs and try again."},
  };
  for (const auto& one : kReasons) {
    if (error == one.cause) return one.words;
  }
  return "the disk or its connection failed. Choose another place.";
}

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

void removeLeftoversOf(const fs::path& path) {
  const fs::path target = saveTarget(path).value_or(path);
  for (int attempt = 0; attempt < kNamesInUse; ++attempt)
    removeLeftover(folderOf(target) / savingName(target, attempt));
}

namespace {

/// Where the bytes would go, if nothing that has the name stands in the way.
Result<fs::path> targetFor(const fs::path& path) {
  auto target = saveTarget(path);
  if (!target) return cannotWrite(path, "its symbolic links form a loop. Choose another name.");
  if (const auto why = obstacle(*target)) return cannotWrite(path, *why);
  return std::move(*target);
}

Result<OpenFile> written(const fs::path& path, std::string_view bytes, Leftovers leftovers) {
  const auto target = targetFor(path);
  if (!target) return fail(target.error());
  if (leftovers == Leftovers::OfAnyFile) removeLeftoversIn(folderOf(*target));
  removeLeftoversOf(*target);
  auto file = fileBeside(*target);
  if (!file) return failedCall(path, file.error());
  if (const auto error = file->write(bytes)) return failedCall(path, error);
  auto held = file->takePlace();
  if (!held) return failedCall(path, held.error());
  return std::move(*held);
}

}  // namespace

Result<void> checkSaving(const fs::path& path) {
  const auto target = targetFor(path);
  if (!target) return fail(target.error());
  if (const auto tried = fileBeside(*target); !tried) return failedCall(path, tried.error());
  return {};
}

Result<void> saveAtomically(const fs::path& path, std::string_view bytes, Leftovers leftovers) {
  const auto saved = written(path, bytes, leftovers);
  if (!saved) return fail(saved.error());
  return {};
}

Result<OpenFile> saveAndHold(const fs::path& path, std::string_view bytes) {
  return written(path, bytes, Leftovers::OfAnyFile);
}

}  // namespace batten
