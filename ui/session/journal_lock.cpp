// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/session/journal_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace batten {

JournalLock::JournalLock(const std::filesystem::path& journal) : path_(journal.native() + ".lock") {}

JournalLock::~JournalLock() { release(); }

bool JournalLock::hold() {
  if (descriptor_ >= 0 && isOnDisk()) {
    (void)::futimens(descriptor_, nullptr);  // What looks unused for days is cleaned away on some machines.
    return true;
  }
  release();
  constexpr int kAttempts = 10;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const int descriptor = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
    if (descriptor < 0) return false;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor);
      return false;
    }
    descriptor_ = descriptor;
    // Its last holder may have removed the file between the two calls: then this is a lock on nothing.
    if (isOnDisk()) return true;
    ::close(descriptor_);
    descriptor_ = -1;
  }
  return false;
}

bool JournalLock::isOnDisk() const {
  struct stat held {
  }, named{};
  return ::fstat(descriptor_, &held) == 0 && ::lstat(path_.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

void JournalLock::release() {
  if (descriptor_ < 0) return;
  if (isOnDisk()) ::unlink(path_.c_str());
  ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace batten
