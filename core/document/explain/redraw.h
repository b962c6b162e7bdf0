// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// A place on a curve, as it is drawn again.
struct RedrawnPoint {
  Vec2 at = Vec2::Zero();    ///< [px]
  double halfWidthPx = 0.0;  ///< Of the stroke; 0 on borders.
  bool isBridge = false;     ///< Laid over a gap in the ink, and declared so.
};
struct RedrawnCurve {
  int curve = 0;  ///< Index into FairedSet::curves.
  ContourKind kind = ContourKind::Outline;
  std::vector<RedrawnPoint> points;  ///< At equal steps of about 1 px.
};

/// The curves that count, with the widths of the lines that they were fitted to.
std::vector<RedrawnCurve> redrawCurves(const PipelineOutput&, const RunContext&);

/// [px] How far ink may lie from a place on a curve that explains it.
double explainingReach(const RedrawnPoint&);

/// Sets the ink that a place on a curve explains: the stroke there, and the reach around it.
void setExplained(BitImage&, const RedrawnPoint&);

/// The page that the curves explain: strokes as wide as they are, and the reach around them; borders, the reach around
/// them, and what they enclose where at least two thirds of it are `ink`.
BitImage redrawPage(const std::vector<RedrawnCurve>&, const PipelineOutput&, const BitImage& ink, const RunContext&);

}  // namespace batten
