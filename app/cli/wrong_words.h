// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace batten::cli {

/// The error of words that cannot be used.
inline tl::unexpected<Error> wrong(std::string message) { return fail(ErrorCode::BadParameter, std::move(message)); }

/// The ending of a name in lower case, with its dot.
std::string endingOf(const std::filesystem::path&);

}  // namespace batten::cli
