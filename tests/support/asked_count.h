// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdlib>

namespace batten::test {

/// How often a test tries something: what the environment variable says, at least 1, or `otherwise` where it is not
/// set.
inline int askedCount(const char* variable, int otherwise) {
  const char* const asked = std::getenv(variable);
  return asked == nullptr ? otherwise : std::max(1, std::atoi(asked));
}

}  // namespace batten::test
