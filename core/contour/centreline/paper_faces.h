// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// The faces of the paper: its 4-connected areas between the ink, as the meshes of a net and the inside of a ring, if
/// they are larger than a square of the pen's width: smaller ones lie in the grain and between strokes that cross.
/// They are sought at the first question.
class PaperFaces {
 public:
  /// @param ink must outlive this.
  PaperFaces(const BitImage& ink, double penPx, const RunContext& context)
      : ink_(ink), leastArea_(kLeastFace * penPx * penPx), context_(context) {}

  /// Whether two faces would be one without this stroke, which lies between two junctions or is closed: beyond the ink
  /// of the strokes that it ends in, the nearest paper at its one side is of another face than that at its other side,
  /// at most places. False when cancelled.
  bool arePartedBy(const StrokePath&);

 private:
  static constexpr double kLeastFace = 1.0;  // [squared pen widths]

  bool isFound();
  std::array<std::optional<int>, 2> facesBeside(const std::vector<StrokePathPoint>&, int i) const;
  std::optional<int> faceBeside(const StrokePathPoint& from, const Vec2& towards) const;

  const BitImage& ink_;
  double leastArea_;
  const RunContext& context_;
  std::optional<RunPieces> pieces_;
  std::vector<std::int64_t> area_;  ///< [px^2] of each piece, by its number.
};

}  // namespace batten
