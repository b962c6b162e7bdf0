// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/contour/centreline/junction/end_pairing.h"
#include "core/contour/contour_set.h"

namespace batten {

/// The pairings of the ends of a junction, and how sure the rule's own is.
struct JunctionPairings {
  std::vector<EndPairs>
      pairings;  ///< The rule's own first, then as many pairs or more, the next best first; last: no pair.
  double cost = 0.0, nextCost = 0.0;  ///< [deg^2] Of the first and of the best other one.
  bool isDoubtful = false;
};

/// @param own what pairEnds gave for the ends, by the same scale, or the pairs of an arc, which may cost more than
/// others: then they are doubtful.
JunctionPairings findPairings(std::span<const MeetingEnd> ends, const EndPairs& own, const PairingScale&);

}  // namespace batten
