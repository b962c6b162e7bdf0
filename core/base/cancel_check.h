// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"

namespace batten {

/// A look at a run for functions that may be called without one: then nothing is ever cancelled. What a function hands
/// back after its run was cancelled is whole in form but of no use; the caller looks for itself. Refers to the context.
class CancelCheck {
 public:
  CancelCheck() = default;
  CancelCheck(const RunContext& context)
      : token_(&context.cancel) {}  // a context is a check, wherever one is asked for

  bool isCancelled() const { return token_ != nullptr && token_->isCancelled(); }

 private:
  const CancelToken* token_ = nullptr;
};

}  // namespace batten
