// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace batten::cli {

/// How alike the curves of two curve JSON files are, every one of the first against every one of the second: one line
/// of JSON on stdout, the most alike pair first.
/// @return the program's exit code.
int runCompare(const std::string& first, const std::string& second);

}  // namespace batten::cli
