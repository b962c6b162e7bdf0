// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/base/result.h"

namespace batten {

/// Writes all bytes or nothing: to a file beside the target, which takes its name once the disk has it. The name is the
/// path's bytes, whatever they spell. A link is followed, the file that it leads to is replaced and keeps its
/// permissions. What a program left that was ended while it saved this file is removed.
/// @return CannotWrite says why and what to do.
Result<void> saveAtomically(const std::filesystem::path& path, std::string_view bytes);

/// Removes what programs left that were ended while they saved this file; the file itself stays.
void removeLeftoversOf(const std::filesystem::path& path);

/// The path that saveAtomically would write: `path`, with links that end it followed, be there a file or not. Nothing
/// if they lead in a circle.
std::optional<std::filesystem::path> saveTarget(const std::filesystem::path& path);

}  // namespace batten
