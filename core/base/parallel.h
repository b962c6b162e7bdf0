// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/base/run_context.h"

namespace batten {

/// Calls `body(begin, end)` for consecutive blocks of at most `grain` indices that cover [0, count), on up to
/// `context.threads` threads. The cut into blocks depends on `count` and `grain` alone, never on the number of threads:
/// whoever writes only to its own block, or reduces block results in order, is deterministic. Blocks not yet started
/// are skipped once the context is cancelled; the caller checks `context.isCancelled()` afterwards. An exception of a
/// body is rethrown here. The threads stay for the next loop, and are shared by loops that run at the same time.
void parallelFor(const RunContext& context, int count, int grain, const std::function<void(int begin, int end)>& body);

/// A good grain for loops over the rows of a page.
inline constexpr int kRowsPerBlock = 64;

/// The number of threads that parallelFor would use at most.
int threadCount(const RunContext& context);

}  // namespace batten
