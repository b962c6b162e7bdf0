// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "core/base/platform.h"
#include "core/base/result.h"

namespace batten {

/// Of programs that were ended while they saved: what is removed from the folder. A look for those of other files takes
/// its time in a folder of many names or on a slow drive, which a window must not wait for.
enum class Leftovers { OfAnyFile, OfThisFile };

/// Writes all bytes or nothing: to a file beside the target, which takes its name once the disk has it. The name is the
/// path's bytes, whatever they spell. A link is followed, the file that it leads to is replaced and keeps its
/// permissions. What programs left in the folder that were ended while they saved is removed, of this file in any case,
/// of others as far as a short look finds it.
/// @return CannotWrite says why and what to do.
Result<void> saveAtomically(const std::filesystem::path& path, std::string_view bytes,
                            Leftovers leftovers = Leftovers::OfAnyFile);
/// The same; takeAlone finds the file taken, from the moment that it has its name on and while the result lives.
Result<OpenFile> saveAndHold(const std::filesystem::path& path, std::string_view bytes);

/// Whether anything is known beforehand to stand in the way of saving: for work that takes long before it saves. An
/// empty file is made beside the target and removed again, as only the system knows who may write where.
/// @return the error that saveAtomically would give. That a disk is full is not known: it takes an empty file all the
/// same.
Result<void> checkSaving(const std::filesystem::path& path);

/// The end of the message "Cannot write NAME: …": why, and what to do.
std::string whyNotWritten(std::error_code);

/// Removes what programs left that were ended while they saved this file; the file itself stays.
void removeLeftoversOf(const std::filesystem::path& path);

/// The path that saveAtomically would write: `path`, with links that end it followed, be there a file or not. Nothing
/// if they lead in a circle.
std::optional<std::filesystem::path> saveTarget(const std::filesystem::path& path);

}  // namespace batten
