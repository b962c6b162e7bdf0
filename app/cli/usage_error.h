// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include "core/base/result.h"

namespace batten::cli {

/// What is wrong with words that the parser refused, and what to do, in one line.
Error usageError(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

}  // namespace batten::cli
