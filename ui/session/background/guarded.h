// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>

#include "core/base/result.h"

namespace batten {

/// Runs `body` and turns what it throws into an error, so that no worker dies of a missing allocation.
template <class T, class F>
Result<T> guarded(F&& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory for this drawing; use a lower resolution.");
  } catch (const std::exception& e) {
    return fail(ErrorCode::Numerical, "The computation failed; undo the last change.", e.what());
  }
}

}  // namespace batten
