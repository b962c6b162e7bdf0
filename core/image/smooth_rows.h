// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/plane.h"

namespace batten {

/// As smooth(), row by row, without a plane for the result: `take` is called by several threads at once, and has the
/// row until it returns.
void smoothRows(const Plane& in, const std::vector<float>& kernel, const RunContext& context,
                const std::function<void(int y, const float* row)>& take);

}  // namespace batten
