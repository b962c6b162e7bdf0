// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/exit_codes.h"

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
      return kUnreadableScan;  // the scan is too large for this machine
    case ErrorCode::CannotWrite:
      return kCannotWrite;
    case ErrorCode::NoCurve:
    case ErrorCode::Numerical:
    case ErrorCode::Cancelled:
      break;
  }
  return kNoCurve;
}

}  // namespace

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
