// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace batten::cli {

/// Prints the commands and their options as JSON: what manual pages and shell completion are made from, so that neither
/// can forget an option. One object a command, the program itself first with an empty name:
/// {"name", "help", "footer", "options": [{"names", "value", "help", "repeated", "required"}]}; the value is empty for
/// a switch, the names are empty for a word without a dash. Options without help are kept out.
/// @return the program's exit code.
int runOptions(const CLI::App& app);

}  // namespace batten::cli
