// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

namespace batten {

/// Which gesture a change of the recipe belongs to: changes of one gesture are one undo step, those of none stay apart.
using GestureId = std::optional<int>;

}  // namespace batten
