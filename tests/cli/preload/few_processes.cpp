// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before the system's library: a system that starts no process while another child lives, and none at all where
// BATTEN_NO_PROCESSES is set.
#include <dlfcn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>

namespace {

bool isRefused() {
  siginfo_t info{};
  const bool hasChild = waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0;
  if (!hasChild && std::getenv("BATTEN_NO_PROCESSES") == nullptr) return false;
  errno = EAGAIN;
  return true;
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" pid_t fork() { return isRefused() ? -1 : next<pid_t()>("fork")(); }

// Qt makes its children by one of these two.
extern "C" int clone(int (*child)(void*), void* stack, int flags, void* words, ...) {
  if (isRefused()) return -1;
  va_list list;
  va_start(list, words);
  void* const parentId = va_arg(list, void*);
  void* const storage = va_arg(list, void*);
  void* const childId = va_arg(list, void*);
  va_end(list);
  using Clone = int(int (*)(void*), void*, int, void*, void*, void*, void*);
  return next<Clone>("clone")(child, stack, flags, words, parentId, storage, childId);
}

extern "C" long syscall(long number, ...) {
  constexpr int kMostWords = 6;
  long words[kMostWords];
  va_list list;
  va_start(list, number);
  for (long& word : words) word = va_arg(list, long);
  va_end(list);
  if (number == SYS_clone && isRefused()) return -1;
  static const auto real = next<long(long, long, long, long, long, long, long)>("syscall");
  return real(number, words[0], words[1], words[2], words[3], words[4], words[5]);
}
