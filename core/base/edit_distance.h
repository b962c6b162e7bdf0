// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace batten {

/// Number of single-letter changes that turn one word into the other.
std::size_t editDistance(std::string_view a, std::string_view b);

/// Whether a word `changes` away from a known one may have been meant as that: a letter in three may be wrong.
bool isNearWord(std::string_view asked, std::size_t changes);

}  // namespace batten
