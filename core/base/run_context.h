// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "core/base/cancel_token.h"

namespace batten {

/// What a stage may know of the run it is part of. It never changes a result: the same input gives the same output with
/// any number of threads.
struct RunContext {
  CancelToken cancel;
  /// Called from any thread with 0..1 within the running stage; may be empty.
  std::function<void(double)> progress;
  /// Upper limit of threads; 0 means as many as the machine has.
  int threads = 0;

  /// Long loops ask this often enough that a cancel acts within 100 ms.
  bool isCancelled() const { return cancel.isCancelled(); }
  void report(double fraction) const {
    if (progress) progress(fraction);
  }
};

}  // namespace batten
