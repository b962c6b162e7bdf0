// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace batten {

/// While it lives, nothing reaches stderr: image libraries print complaints of their own there, and an error of this
/// program is to be one line. Does nothing in sanitizer builds, whose reports must be seen.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_ = -1;  ///< The real stderr; -1 = nothing to put back.
};

}  // namespace batten
