// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "core/base/result.h"

namespace batten {

/// The error of a file that does not read back as written.
inline tl::unexpected<Error> readsBackOtherwise(std::string detail) {
  return fail(ErrorCode::CannotWrite, "The written file does not read back correctly. Export to another format.",
              std::move(detail));
}

}  // namespace batten
