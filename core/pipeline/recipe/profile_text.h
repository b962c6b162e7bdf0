// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/fairing/profile/drawn_profile.h"

namespace batten {

/// A drawn profile as text: "0:0.01 0.5:0.02 1:0.01" or "none", share of the arc length and curvature in 1/mm. Reads
/// back exactly.
std::string profileToText(std::span<const ProfilePoint>);
/// @return BadParameter that says what is expected, as the end of a sentence.
Result<std::vector<ProfilePoint>> profileFromText(std::string_view text);

}  // namespace batten
