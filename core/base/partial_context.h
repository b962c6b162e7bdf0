// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/run_context.h"

namespace batten {

/// The context of a part of some work: its progress of 0..1 runs from one fraction of the whole to another.
inline RunContext partialContext(const RunContext& whole, double from, double to) {
  RunContext part = whole;
  if (whole.progress)
    part.progress = [all = whole.progress, from, to](double fraction) { all(from + fraction * (to - from)); };
  return part;
}

}  // namespace batten
