// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

#include "core/base/parallel.h"
#include "core/base/run_context.h"

namespace batten {

/// Many items fill the threads, and each alone stays on its own; of a few the longest would keep one busy and the
/// others waiting.
inline RunContext itemContext(const RunContext& context, std::size_t items) {
  constexpr std::size_t kMany = 4;  // a thread
  RunContext inner = context;
  inner.progress = nullptr;
  if (items >= kMany * threadCount(context)) inner.threads = 1;
  return inner;
}

/// Runs `work(i)` for all items, with the stage's progress.
template <class Work>
void forEachItem(const RunContext& context, std::size_t items, const Work& work) {
  std::atomic<std::size_t> done{0};
  parallelFor(context, static_cast<int>(items), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      work(i);
      context.report(static_cast<double>(++done) / static_cast<double>(items));
    }
  });
}

}  // namespace batten
