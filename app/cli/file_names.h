// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace batten::cli {

/// A text that is the same for all names of one file, be they links of either kind or folders named differently. Of
/// links that lead to no file yet what would be written counts. It is good for comparing only.
std::string fileKey(const std::filesystem::path&);

/// Whether two names mean one file.
bool isSameFile(const std::filesystem::path& first, const std::filesystem::path& second);

/// "drawing-p2.svg" of "drawing.svg"; endings of two parts stay whole. The empty name stays empty.
std::string withPage(const std::string& name, int page);

}  // namespace batten::cli
