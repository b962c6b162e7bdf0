// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/trace_command.h"

namespace batten::cli {

/// Looks at a scan and says which settings it suggests: one line of JSON on stdout. Writes no file and decides nothing.
/// Returns the exit code.
int runSuggest(const TraceArguments&);

}  // namespace batten::cli
