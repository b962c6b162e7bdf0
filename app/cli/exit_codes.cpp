// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/exit_codes.h"

#include <array>
#include <iostream>

#include "core/base/shown_text.h"

namespace batten::cli {
namespace {

int codeOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadParameter:
      return kWrongUsage;
    case ErrorCode::UnreadableScan:
    case ErrorCode::OutOfMemory:
      return kUnreadableInput;  // the scan is too large for this machine
    case ErrorCode::CannotWrite:
      return kCannotWrite;
    case ErrorCode::NoCurve:
    case ErrorCode::Numerical:
    case ErrorCode::Cancelled:
      break;
  }
  return kNoCurve;
}

struct ExitRow {
  ExitCode code;
  const char* means;
};

/// The help page on the command line has the same table.
constexpr std::array kExitRows = {
    ExitRow{kDone, "success"},
    ExitRow{kWrongUsage, "wrong usage, or a recipe or manifest that cannot be used"},
    ExitRow{kUnreadableInput, "a scan or a file of curves cannot be read"},
    ExitRow{kNoCurve, "no curve found"},
    ExitRow{kCannotWrite, "an output, including stdout, cannot be written"},
    ExitRow{kPagesFailed, "pages of a batch have failed"},
    ExitRow{kStopped, "a batch was stopped before its end"},
};

}  // namespace

std::string exitCodeHelp() {
  std::string text;
  for (const ExitRow& row : kExitRows)
    text.append(text.empty() ? "" : "; ").append(std::to_string(row.code)).append(" ").append(row.means);
  return text;
}

Error ofInput(Error error) {
  if (error.code == ErrorCode::BadParameter) error.code = ErrorCode::UnreadableScan;
  return error;
}

int reportError(const Error& error) {
  // Names that messages hold may hold anything: the terminal gets one line of text.
  std::cerr << "batten-cli: " << shownText(error.message) << std::endl;
  return codeOf(error.code);
}

int endOutput() {
  if (std::cout.flush()) return kDone;
  return reportError(
      {ErrorCode::CannotWrite, "Cannot write the result to stdout. Redirect it to a disk with free space.", {}});
}

}  // namespace batten::cli
