// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace batten {

/// Says that a journal belongs to a program that runs. The system gives the lock back when its holder ends, however it
/// ends, so that no clock and no table of programs has to be asked whether it still lives.
class JournalLock {
 public:
  /// Of the journal at that path; its lock lies beside it, as "<journal>.lock". Holds nothing yet.
  explicit JournalLock(const std::filesystem::path& journal);
  JournalLock(const JournalLock&) = delete;
  JournalLock& operator=(const JournalLock&) = delete;
  /// Gives the lock back and removes its file.
  ~JournalLock();

  /// Takes the lock, renews it, or takes it anew where somebody has removed its file. False while another holder has it
  /// or the folder takes no files: ask again later.
  bool hold();

 private:
  bool isOnDisk() const;
  void release();

  std::filesystem::path path_;
  int descriptor_ = -1;  ///< -1: not held.
};

}  // namespace batten
