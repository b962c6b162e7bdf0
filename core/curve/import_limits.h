// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "core/base/result.h"

namespace batten {

/// Places at which a file may turn sharply. Beyond that its points are in no order, and their lines would take minutes.
inline constexpr std::size_t kMostSharpTurns = 50'000;

/// What is wrong with a file that turns sharply at so many places; absent where they are few enough.
std::optional<Error> tooManySharpTurns(std::size_t turns);

}  // namespace batten
