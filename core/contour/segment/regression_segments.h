// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/contour/corner/corner_marks.h"

namespace batten {

enum class SegmentMode {
  Stations,  ///< Equal arc length, both ends included (default).
  Sturges,   ///< floor(1 + log2 N) groups of the N points of the line (000 III), PCA line each; of a pen stroke the
             ///< points that were drawn.
  Count,     ///< A fixed number of groups, PCA line each.
  Adaptive,  ///< Stations, as few as keep the line within `tolerancePx` of the local parabolas.
};

struct SegmentParams {
  SegmentMode mode = SegmentMode::Stations;
  int count =
      0;  ///< 0 or 2..2000. Number of segments or stations; 0 = from the length (one per `spacingPx`, at least 4).
  double spacingPx = 40.0;    ///< [px] 8..400. Length of contour per station when `count` is 0.
  double tolerancePx = 0.15;  ///< [px] 0.02..5. Adaptive: largest distance of the line (points averaged over 5 px) from
                              ///< the local parabola.
  bool operator==(const SegmentParams&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const SegmentParams&);

/// A regression segment: the line fitted to a group of points. Image frame or model frame, as its holder says.
struct Station {
  Vec2 point = Vec2::Zero();       ///< Midpoint (groups) or the station itself.
  Vec2 direction = Vec2::UnitX();  ///< Unit, along the contour.
  Vec2 from = Vec2::Zero();        ///< Ends of the drawn segment.
  Vec2 to = Vec2::Zero();
  /// [-] Part of the piece's length that lies before it: 0..1, on a closed piece up to 2 for stations added behind its
  /// start. Absent for groups of points.
  std::optional<double> along = {};
};

struct PieceSegments {
  std::vector<Station> stations;  ///< Along the piece. Smooth closed pieces: the last is followed by the first.
  double residualRmsPx = 0.0;     ///< [px] of the points from their segments or local parabolas.
};
struct SegmentSet {
  std::vector<PieceSegments> pieces;  ///< One per piece of the PieceSet, same order.
};

/// Sturges' number of groups, floor(1 + log2 N). @pre n >= 1.
int sturgesGroups(int n);
/// Group boundaries floor(n * i / k), i = 0..k.
std::vector<int> groupBoundaries(int n, int k);

/// Regression segments of every piece. Ends at corners are kept exactly.
Result<SegmentSet> regressionSegments(const PieceSet&, const SegmentParams&, const RunContext&);

}  // namespace batten
