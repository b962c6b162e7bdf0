// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/base/result.h"

namespace batten::cli {

/// What the program returns to the shell. A contract: scripts rely on these numbers.
enum ExitCode : int {
  kDone = 0,
  kWrongUsage = 2,
  kUnreadableInput = 3,
  kNoCurve = 4,
  kCannotWrite = 5,
  kPagesFailed = 6,  ///< Of a batch: at least one page failed, all others have ended.
  kStopped = 7,      ///< A batch ended before its last page: SIGINT, or too many failures.
};

/// The table of exit codes, for the help: "0 success; 2 …".
std::string exitCodeHelp();

/// The same error as one of a file that cannot be read, if it was found in one.
Error ofInput(Error);

/// Prints the error as one line on stderr and gives the exit code that belongs to it.
int reportError(const Error&);

/// Ends a command whose results have been written to std::cout: flushes them and gives kDone, or says on stderr that
/// they could not be written (a full disk, a closed pipe) and gives kCannotWrite.
int endOutput();

}  // namespace batten::cli
