// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/result.h"

namespace batten {

/// Writes all bytes or nothing: to a temporary file beside the target, then renames. CannotWrite says why and what to
/// do.
Result<void> saveAtomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace batten
