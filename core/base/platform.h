// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>

namespace batten {

/// What only the operating system does, and in platform_memory.h what only it knows. platform.cpp and
/// platform_memory.cpp do it by POSIX, platform_windows.cpp by Windows; no other file of core, ui and app calls a
/// system by anything but standard C++ and Qt, so that another system is a matter of one file. Where a system has no
/// answer, there is none.

/// What tells a running process from all that run, ran or will run: its number and, where the system says it, when it
/// began and in which start of the system, since numbers are given again. Empty if no process of this number runs; one
/// that has ended does not run, though its parent may not have taken note of it.
std::string processMark(std::int64_t processId);

/// Whether a person looks at what goes to stderr.
bool stderrIsTerminal();

/// A file that would become larger than is allowed here fails as a full disk does, and does not end the program.
void reportLargeFilesAsErrors();

/// To be called once, before children are started: they do not outlive this process, however it ends, where the system
/// ties them to their parent. See becomeDependentChild for where each child ties itself.
void tieChildrenToThisProcess();

/// To be called in a child process before its program starts, where there is such a moment: Ctrl+C in the terminal is
/// the parent's to hear, and the child does not outlive a parent that is killed. Calls nothing that may not be called
/// after fork().
void becomeDependentChild();

/// To be called after becomeDependentChild: the program words[0] takes the place of the child, called with these words,
/// which a null pointer ends. They are bytes, whatever they spell. Returns only where that fails or is not known.
void becomeProgram(const char* const* words);

/// How many threads may be started so that most of the address space that the process is allowed is left to the work;
/// absent where it is not limited.
std::optional<int> threadsWithinLimits();

/// A file or folder, whatever names lead to it: links of either kind give it no other.
struct FileId {
  std::uint64_t device = 0, number = 0;
  auto operator<=>(const FileId&) const = default;
};
/// Of what the path leads to, with links followed; nullopt if there is nothing.
std::optional<FileId> fileId(const std::filesystem::path&);

/// Whether it is a folder in which files may be made.
bool isWritableFolder(const std::filesystem::path&);

/// While it lives, nothing reaches stderr: image libraries print complaints of their own there, and an error of this
/// program is to be one line. Does nothing in sanitizer builds, whose reports must be seen.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  std::optional<int> kept_;  ///< The real stderr.
};

/// What the system keeps open for one of the classes below; closed with it. Each system has its own.
struct SystemFile;
struct CloseSystemFile {
  void operator()(SystemFile*) const;
};
using OpenFile = std::unique_ptr<SystemFile, CloseSystemFile>;

enum class FileKind { Ordinary, Folder, Other };

/// A file that is open for reading. Opening never waits, whatever has the name, and does nothing to a device.
class ReadableFile {
 public:
  static tl::expected<ReadableFile, std::error_code> open(const std::filesystem::path&);

  FileKind kind() const { return kind_; }
  std::uint64_t size() const { return size_; }  ///< [bytes] Of an ordinary file, when it was opened; else 0.
  /// Fills `bytes` from this place of the file on. @return std::errc::io_error if there are fewer.
  std::error_code read(std::span<std::byte> bytes, std::uint64_t from = 0) const;

 private:
  ReadableFile(OpenFile file, FileKind kind, std::uint64_t size) : file_(std::move(file)), kind_(kind), size_(size) {}
  OpenFile file_;  ///< Null for what is no ordinary file.
  FileKind kind_;
  std::uint64_t size_;
};

/// A name by which code of this program can open once more what is open already, though it may have no name in any
/// folder; nullopt where the system knows none. @param descriptor as the C library counts open files.
std::optional<std::string> nameOfOpenFile(int descriptor);

/// A file that takes the place of another, or of none, once it is whole. While it is written no other program takes it
/// for a leftover (removeLeftover); it goes with this object unless it has taken the place. The folder is the one that
/// had its name at the beginning, even if it is renamed meanwhile, where the system allows that at all.
class ReplacingFile {
 public:
  /// Beside `target`, no link, under the name `name`. It gets the permissions of a file that it will replace.
  /// @return std::errc::file_exists: take another name; any other: the folder takes no file, or the target may not be
  /// written.
  static tl::expected<ReplacingFile, std::error_code> create(const std::filesystem::path& target,
                                                             const std::string& name);
  ReplacingFile(ReplacingFile&&) noexcept;
  ReplacingFile& operator=(ReplacingFile&&) = delete;
  ~ReplacingFile();

  /// Adds to the file. A full disk is std::errc::no_space_on_device, be it the disk's size or the user's share of it.
  std::error_code write(std::string_view bytes);
  /// Waits for the disk to have the bytes, then gives the file the target's name. To be called once. While the result
  /// lives, takeAlone finds the file taken; there was no moment in which it did not.
  tl::expected<OpenFile, std::error_code> takePlace();

 private:
  ReplacingFile(OpenFile folder, OpenFile file, std::filesystem::path target, std::string name);
  OpenFile folder_, file_;
  std::filesystem::path target_;
  std::string name_;  ///< Empty: it has taken the place, or was moved from.
};

/// Removes an ordinary file of this user that a ReplacingFile has left whose program was ended; leaves one that is
/// still written, and whatever else has that name.
void removeLeftover(const std::filesystem::path&);

/// Takes an ordinary file, no link, for one holder in this or any program while the result lives: whoever asks
/// meanwhile gets null, as for a file that is not there or cannot be locked. It may be read, written and replaced all
/// the same.
OpenFile takeAlone(const std::filesystem::path&);

/// A file to which several programs add whole lines at the same time.
class SharedLines {
 public:
  /// Makes the file if there is none. What is no ordinary file (a pipe, a terminal) is written to and never read.
  static tl::expected<SharedLines, std::error_code> open(const std::filesystem::path&);

  /// [bytes] Of an ordinary file; else 0.
  std::uint64_t size() const;
  /// At most `most` bytes from `offset` on; fewer at the file's end.
  tl::expected<std::string, std::error_code> read(std::uint64_t offset, std::size_t most) const;
  /// Adds a text that ends with a line break, while no other program adds. A last line that was cut off is ended first.
  /// A file that cannot take all of it is left as it was.
  std::error_code add(std::string_view text);

 private:
  SharedLines(OpenFile file, FileKind kind) : file_(std::move(file)), kind_(kind) {}
  OpenFile file_;
  FileKind kind_;
};

enum class LockState {
  Held,
  Busy,        ///< Another holder has it.
  Impossible,  ///< The folder takes no files, or its disk knows no locks.
};

/// A file that says that a program runs. The system gives the lock back when its holder ends, however it ends.
class LockFile {
 public:
  /// Holds nothing yet.
  explicit LockFile(std::filesystem::path path);
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;
  /// Gives the lock back and removes the file.
  ~LockFile();

  /// Takes the lock, renews the time of its file, or takes it anew where somebody has removed the file.
  LockState tryHold();
  bool hold() { return tryHold() == LockState::Held; }

 private:
  void release();
  std::filesystem::path path_;
  OpenFile file_;  ///< Null: not held.
};

}  // namespace batten
