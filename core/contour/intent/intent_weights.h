// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

namespace batten {

/// Rounds of grouping: single strokes, then the bundles found, twice.
constexpr int kIntentRounds = 3;

/// How one round weighs what it sees.
struct RoundWeights {
  /// Log-odds that what lies side by side, or what meets end to end, belongs to one curve: a bias, then a weight for
  /// each number that sideFeatures(), endFeatures() give in that round.
  std::vector<double> side, end;
  /// How sure the round is to be before it joins: what is added to the log-odds.
  double sideCaution = 0.0, endCaution = 0.0;
  double sideFactor = 1.0;  ///< What a pair side by side counts against one end to end.
};
using IntentWeights = std::array<RoundWeights, kIntentRounds>;

/// Learned from rough sketches whose strokes a person had grouped, by logistic regression.
const IntentWeights& learnedWeights();

/// The bias and the weighted sum. @pre one weight more than features.
double logOdds(const std::vector<double>& weights, std::span<const double> features);

}  // namespace batten
