// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace batten {

int threadCount(const RunContext& context) {
  if (context.threads > 0) return context.threads;
  return std::max(1u, std::thread::hardware_concurrency());
}

void parallelFor(const RunContext& context, int count, int grain, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  const int step = std::max(1, grain);
  const int blocks = (count - 1) / step + 1;
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto work = [&] {
    for (int block = next++; block < blocks && !context.isCancelled(); block = next++) {
      try {
        body(block * step, std::min(count, (block + 1) * step));
      } catch (...) {
        const std::scoped_lock lock(failureMutex);
        if (!failure) failure = std::current_exception();
        next = blocks;
      }
    }
  };
  const int helpers = std::min(threadCount(context), blocks) - 1;
  {
    std::vector<std::jthread> pool;
    pool.reserve(std::max(0, helpers));
    try {
      for (int i = 0; i < helpers; ++i) pool.emplace_back(work);
    } catch (const std::system_error&) {
      // The system gives no more threads: those there are do the work, this one at the least.
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace batten
