// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before the system's library: a disk that takes every byte and then cannot keep them.
#include <cerrno>

extern "C" int fdatasync(int /*descriptor*/) {
  errno = EIO;
  return -1;
}
