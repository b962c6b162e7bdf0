// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"

namespace batten {

/// That two nodes belong together (positive) or do not (negative).
struct WeightedPair {
  int a = 0, b = 0;
  double weight = 0.0;  ///< [-] Logarithm of odds.
};

/// Correlation clustering by greedy additive contraction (Keuper et al., ICCV 2015): joins the pair with the largest
/// weight, adds up the weights of what becomes one pair, and goes on until no weight is positive.
/// @return the cluster of every node, numbered from 0 in the order of their first nodes. Same result whatever the order
/// of the pairs. Not complete when cancelled.
std::vector<int> contractGreedily(int nodes, const std::vector<WeightedPair>& pairs, const RunContext& context);

}  // namespace batten
