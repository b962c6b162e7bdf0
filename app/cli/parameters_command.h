// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten::cli {

/// Prints the parameter table to stdout: aligned text, or JSON for programs. Returns the exit code.
int runParameters(bool asJson);

}  // namespace batten::cli
