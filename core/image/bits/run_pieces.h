// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// A horizontal run of ink: pixels [x0, x1) of row y.
struct InkRun {
  int y, x0, x1;
};

/// The connected pieces of a bit image, found on runs and not on pixels.
struct RunPieces {
  std::vector<InkRun> runs;  ///< In reading order.
  std::vector<int> piece;    ///< For every run, the index of the first run of its piece.
};

enum class Connectivity { Four, Eight };
/// The piece that a pixel lies in; absent on paper.
std::optional<int> pieceAt(const RunPieces& pieces, int x, int y);
/// The pieces of all ink of an image. Not complete when cancelled.
RunPieces findPieces(const BitImage& image, Connectivity connectivity, const RunContext& context);

/// [px] For the first run of every piece the area of the piece, for the others 0.
std::vector<std::int64_t> areasOfPieces(const RunPieces&);

/// The pixels [x0, x1) and rows [y0, y1) that a piece lies in.
struct PieceBox {
  int x0 = std::numeric_limits<int>::max(), y0 = std::numeric_limits<int>::max(), x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  double diagonal() const { return std::hypot(width(), height()); }
};
/// For the first run of every piece the box of the piece, for the others none.
std::vector<PieceBox> boxesOfPieces(const RunPieces&);

/// Sets the pixels of a run.
void setBits(BitImage& image, const InkRun& run);
/// Clears the pixels of a run.
void clearBits(BitImage& image, const InkRun& run);
/// Sets in `to` the pixels of the run that are set in `from`, which is as large.
void copyBits(const BitImage& from, const InkRun& run, BitImage& to);
/// How many pixels of the run are set.
int countBits(const BitImage& image, const InkRun& run);

/// What a piece of ink must have to stay.
struct PieceRule {
  std::int64_t minArea = 0;         ///< [px]
  double minDiagonal = 0.0;         ///< [px] of its box, counted over pixels.
  const BitImage* seeds = nullptr;  ///< It must hold one of these pixels; absent: no such rule.
};
/// `image` without the 8-connected pieces that break the rule.
BitImage keepPieces(const BitImage& image, const PieceRule& rule, const RunContext& context);

/// Fills the 4-connected holes in the ink with fewer than `area` pixels.
void fillHoles(BitImage& image, int area, const RunContext& context);

}  // namespace batten
