// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/construct/typical/typical_path.h"

namespace batten {

/// Joints that bend one way, clearly: first and last index. Elsewhere the line is straight or its bend changes side.
struct JointRun {
  std::size_t first = 0, last = 0;
};

/// In their order along the line.
std::vector<JointRun> bendingRuns(std::span<const Joint> joints);

/// A first path along joints that roughly follow the line: typical curves wherever it clearly bends one way, Hermite
/// pieces elsewhere. Lengths in the unit of noise (px). Closed: the last joint repeats the first.
/// @param places joints where the user wants the path divided, by index in order; empty = divided as needed.
TypicalPath roughTypicalPath(std::span<const Joint> joints, bool closed, std::span<const std::size_t> places);

}  // namespace batten
