// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/plane.h"
#include "core/image/threshold/page_edges.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// Edge pixels that an estimate needs at least, and those that make it half certain.
inline constexpr int kMinVotes = 15;
inline constexpr float kVotesOfConfidence = 60.0f;  // make it half certain

struct PaperEstimate {
  PaperBackground paper;
  std::vector<std::uint8_t> isPaper;  ///< Per cell: no edge, and as bright as the paper around.
};

/// The paper's own grey below the drawing: slopes are measured where there is no edge, filled where there is, and
/// summed up; a step at an edge of the ink does not enter. Twice corrected by the cells that turned out to be paper.
PaperEstimate estimatePaper(const Plane& grey, const PageEdges& edges, int shrink, int cellPx,
                            const RunContext& context);

}  // namespace batten
