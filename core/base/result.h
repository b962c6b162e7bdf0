// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace batten {

/// What kind of expected failure happened. Bugs are assertions, not errors; cancellation is never shown to the user.
enum class ErrorCode {
  Cancelled,       ///< The caller asked to stop. Not a failure.
  BadParameter,    ///< A parameter or edit is out of its range. CLI exit code 2.
  UnreadableScan,  ///< Missing, damaged, empty, too large or not an image. CLI exit code 3.
  NoCurve,         ///< The picture was read but holds no line that could be followed. CLI exit code 4.
  CannotWrite,     ///< The output could not be written. CLI exit code 5.
  Numerical,       ///< A system was singular or a solver could not start.
  OutOfMemory,     ///< An allocation failed.
};

/// An expected failure. `message` is one line for the user that says what is wrong and what to do; `detail` is for the
/// log.
struct Error {
  ErrorCode code = ErrorCode::Numerical;
  std::string message;
  std::string detail;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Shorthand for returning a failure: `return fail(ErrorCode::NoCurve, "…")`.
inline tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string detail = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(detail)});
}
/// The same with an error that another function gave.
inline tl::unexpected<Error> fail(Error error) { return tl::unexpected<Error>(std::move(error)); }
/// The failure of a cancelled run.
inline tl::unexpected<Error> cancelled() { return fail(ErrorCode::Cancelled, "Cancelled."); }

}  // namespace batten
