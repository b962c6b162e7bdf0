// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace batten {

/// The stages in the order in which they run. Each takes the one before it (and the scan where it says so).
enum class StageId {
  Thresholds,  ///< 64 region thresholds and the paper background from the scan.
  Binary,      ///< Thresholded mask.
  Filtered,    ///< After the neighbourhood filter.
  Edges,       ///< Laplacian zero crossings (shown).
  Contours,    ///< Ordered, sub-pixel.
  Pieces,      ///< Cut at the corners.
  Segments,    ///< Regression segments.
  Curves,      ///< Constructed ("sketched") curves.
  Faired,      ///< Faired curves.
};
// in the order in which they run
inline constexpr std::array kStages = {StageId::Thresholds, StageId::Binary,   StageId::Filtered,
                                       StageId::Edges,      StageId::Contours, StageId::Pieces,
                                       StageId::Segments,   StageId::Curves,   StageId::Faired};
/// Its place in arrays with one entry a stage.
constexpr std::size_t indexOf(StageId stage) { return static_cast<std::size_t>(stage); }
/// "thresholds", "binary", … as --dump and reports name them.
std::string_view name(StageId);
/// Absent: no stage has this name.
std::optional<StageId> stageFromName(std::string_view);

}  // namespace batten
