// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pthread.h>
#include <QStringList>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace batten::test {

/// Notes the calls that the thread of its constructor is in while something takes longer than it should, seen from a
/// thread of its own every few milliseconds.
class StackSampler {
 public:
  StackSampler();
  ~StackSampler();
  StackSampler(const StackSampler&) = delete;
  StackSampler& operator=(const StackSampler&) = delete;

  /// Something begins.
  void begin();
  /// It has ended. @return The stacks that were seen, one a line: calls of this program as PROGRAM+0xOFFSET for
  /// addr2line, those of libraries by name, the innermost first. Empty unless `wanted`.
  QStringList end(bool wanted);

 private:
  using Stack = std::vector<void*>;
  void watch();

  pthread_t watched_;
  std::atomic<bool> isOver_ = false;
  std::atomic<long long> sinceNs_ = 0;  ///< 0: nothing goes on.
  std::mutex mutex_;
  std::vector<Stack> seen_;  ///< Guarded by the mutex.
  std::thread thread_;       ///< The last: it uses the others.
};

}  // namespace batten::test
