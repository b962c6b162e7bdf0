// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/label/ink_graph.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// Measurements of one connected component of ink.
struct LabelledPiece {
  int firstRun = 0;  ///< RunPieces::piece of its runs.
  std::vector<int> paths;
  std::int64_t areaPx = 0;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< [px] its box, [x0, x1) x [y0, y1).
  double largestRadiusPx = 0.0;        ///< Along its skeleton.
  double strokesPx = 0.0;              ///< Length of its paths that are at least kStrokeWidths long.
  double penPx = 1.0;                  ///< Width of the pen that is taken for its strokes.
  double mainPenPx = 1.0;              ///< The same, but by length: the width that most of the ink has.
  bool isBlot = false;                 ///< No stroke path is long enough to have a direction.
  /// [px] Where it is widest.
  double widestPx() const { return 2.0 * largestRadiusPx - kRadiiBeyondWidthPx; }
};

/// Ink shorter than this many of its widths has no direction.
inline constexpr double kStrokeWidths = 3.0;

/// The pieces of ink with their paths and pens. `pagePenPx`: median width of all paths long enough, weighed by
/// their lengths in widths; absent: there is none.
struct PiecesOfPage {
  std::vector<LabelledPiece> pieces;
  std::optional<double> pagePenPx;
  double widestPenPx = std::numeric_limits<double>::infinity();  ///< Wider ink was not drawn with a pen.
};
/// The least value that half of the weight lies at or below; absent: there is no value.
std::optional<double> weightedMedian(std::vector<std::pair<double, double>> valueAndWeight);

/// Measures the pieces of the ink whose paths the graph holds.
PiecesOfPage measurePieces(const InkGraph&, const RunPieces&);

/// Labels paths, junctions and skeleton pixels. A path is a stroke when one pen width explains it along at least
/// kStrokeWidths widths; what no stroke explains and is wider than coreWidth of the strokes joined to it is a shape.
/// Short limbs of a shape are strokes only where the page shows that a pen of their width was used.
void labelPaths(InkGraph&, const PiecesOfPage&);

}  // namespace batten
