// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "core/base/result.h"

namespace batten {

/// What a check says of a file that does not hold what was to be written.
inline tl::unexpected<Error> readsBackOtherwise(std::string detail) {
  return fail(ErrorCode::CannotWrite,
              "The file that was written reads back as something else. Export to another format.", std::move(detail));
}

}  // namespace batten
