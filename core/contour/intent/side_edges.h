// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/intent/strips.h"

namespace batten {

/// Where the normal of a sample of one strip crosses another.
struct StripCrossing {
  int sample = 0, other = 0;  ///< Of the strip, of the other one.
  double across = 0.0;        ///< [stroke widths] along the strip's left normal.
  bool isSeen = false;        ///< No third strip lies between.
  bool isAlong = true;        ///< The other runs in the strip's direction of travel.
};

/// Two strips that run side by side: where either crosses the normals of the other.
struct StripPair {
  int a = 0, b = 0;                         ///< a < b.
  std::vector<StripCrossing> fromA, fromB;  ///< In the order of the samples.
};

/// Quantile of the distances of a pair that stands for the largest: one crossing in ten may be that of another loop.
inline constexpr double kMostQuantile = 0.9;

/// All pairs of strips of about the same direction (within 30 degrees) no farther apart than `reach`, that see each
/// other in at least a third of the crossings; `all`: whatever lies between them. Not complete when cancelled.
std::vector<StripPair> findStripPairs(const std::vector<Strip>& strips, double reach, bool all,
                                      const RunContext& context);

/// How a pair of strips looks, for the log-odds that they are one curve. See intent_weights.h for the order.
constexpr int kSideFeatures = 30, kSideFeaturesLater = 43;

/// What the look of a pair depends on beside it.
struct PairView {
  const std::vector<Strip>& strips;
  double scale = 1.5;    ///< [stroke widths] the distance for merging that suits the page as a whole.
  bool isLater = false;  ///< The strips are bundles.
};

/// Numbers of a pair: distances in stroke widths, counts, angles in degrees.
struct SideMeasures {
  double middle = 0.0, most = 0.0, least = 0.0;  ///< Distance: median, kMostQuantile, the least.
  double overlap = 0.0;                          ///< Samples, in the direction in which it is longer.
  double angleDeg = 0.0;
  double parting = 0.0;  ///< By how much farther apart they are at one end than at the other.
  bool isCrossing = false;
  int endsBeside = 0;  ///< Ends of either beside the other: free ones at first, all for bundles.
  int freeEndsBeside = 0;
  int freeEndsInside = 0;  ///< Of these, those beside which the other goes on: ends that are not level.
  double shareSeen = 0.0, shareA = 0.0, shareB = 0.0;  ///< 0..1 of the crossings, of either strip.
  bool isWithin = false;                               ///< Both ends of the shorter lie beside the longer.
};
SideMeasures measureSide(const StripPair& pair, const PairView& view);
/// The numbers that the log-odds are a weighted sum of; `sameLine`: both come from one line.
std::vector<double> sideFeatures(const SideMeasures& m, const StripPair& pair, const PairView& view, bool sameLine);

}  // namespace batten
