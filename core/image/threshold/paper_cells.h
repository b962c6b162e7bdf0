// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/plane.h"
#include "core/image/threshold/ink_edges.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// Depths at the crests of edges, by their signs.
struct SignedDepths {
  double darker = 0.0, brighter = 0.0;  ///< Sums, weighted by the strength of the crests; neither is negative.
  /// @param depth [grey] positive: brighter than the paper.
  void add(double strength, double depth) { (depth > 0.0 ? brighter : darker) += strength * std::fabs(depth); }
  /// Ink and highlights, as white chalk on toned paper: the edges of the highlights tell nothing of the ink.
  bool areMixed() const {
    constexpr double kLeastOfBoth = 0.2;  // of the greater; on white paper the lesser is noise
    return std::min(darker, brighter) > kLeastOfBoth * std::max(darker, brighter);
  }
};

struct PaperEstimate {
  PaperBackground paper;
  std::vector<std::uint8_t> isPaper;  ///< Per cell: no edge, and as bright as the paper around.
};

/// The paper's own grey below the drawing: slopes are measured where there is no edge, filled where there is, and
/// summed up; a step at an edge of the ink does not enter. Twice corrected by the cells that turned out to be paper.
PaperEstimate estimatePaper(const Plane& grey, const InkEdges& edges, int shrink, int cellPx,
                            const RunContext& context);

}  // namespace batten
