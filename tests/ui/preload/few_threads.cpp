// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before the system's library: a system that has BATTEN_THREADS threads at once for a program, beside its first.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <memory>

namespace {

std::atomic<int> running{0};

struct Work {
  void* (*function)(void*);
  void* argument;
};

void* run(void* work) {
  const std::unique_ptr<Work> own(static_cast<Work*>(work));
  void* const result = own->function(own->argument);
  --running;
  return result;
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*),
                              void* argument) {
  using Create = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto real = reinterpret_cast<Create*>(dlsym(RTLD_NEXT, "pthread_create"));
  const char* const most = std::getenv("BATTEN_THREADS");
  if (++running > (most == nullptr ? 0 : std::atoi(most))) {
    --running;
    return EAGAIN;
  }
  auto work = std::make_unique<Work>(Work{function, argument});
  const int failed = real(thread, attributes, run, work.get());
  if (failed == 0)
    static_cast<void>(work.release());  // the thread's now
  else
    --running;
  return failed;
}
