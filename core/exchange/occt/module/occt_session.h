// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <string>

#include "core/base/result.h"

namespace batten {

/// Open CASCADE keeps its settings in one place for the whole program: who holds this has it alone, and silent, since
/// it would write its messages to stdout.
class OcctSession {
 public:
  OcctSession();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// What it says when Open CASCADE fails at a file of ours.
tl::unexpected<Error> occtFailed(const std::string& what, std::string detail = {});

}  // namespace batten
