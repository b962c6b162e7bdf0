// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/import_limits.h"

#include <string>

namespace batten {

std::optional<Error> tooManySharpTurns(std::size_t turns) {
  if (turns <= kMostSharpTurns) return std::nullopt;
  return Error{ErrorCode::BadParameter,
               "The points of a file may turn sharply at " + std::to_string(kMostSharpTurns) +
                   " places at most, but do so at " + std::to_string(turns) +
                   ": put them in the order in which the line runs.",
               {}};
}

}  // namespace batten
