// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace batten {

/// upperMedian() of many values of a few grey: those of the bin that holds it are sorted, the others counted. Exact for
/// all others, too, but slower. @pre not empty, no NaN.
float binnedMedian(const std::vector<float>& values);

}  // namespace batten
