// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>

#include "tests/cli/program.h"

namespace batten::test {

/// Input that was made to hang, to crash or to take all memory.
class HostileInput : public Program {
 protected:
  /// One line of error with this exit code, within seconds.
  void expectRefused(const std::string& words, int code, const std::string& says) const {
    const auto begin = std::chrono::steady_clock::now();
    expectError(words, code, says);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << words;
  }
};

}  // namespace batten::test
