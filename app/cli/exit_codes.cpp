// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/exit_codes.h"

#include <algorithm>
#include <iostream>

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
  std::string line = error.message;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::cerr << "batten-cli: " << line << std::endl;
  return codeOf(error.code);
}

int endOutput() {
  if (std::cout.flush()) return kDone;
  return reportError(
      {ErrorCode::CannotWrite, "The result cannot be written to stdout. Send it where there is room.", {}});
}

}  // namespace batten::cli
