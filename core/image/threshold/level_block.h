// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace batten {

/// A block of a page as large as is smoothed and compared at once: 32 x 8 px.
struct LevelBlock {
  static constexpr int kAcross = 32, kDown = 8;  // px
  static constexpr int kMostRadius = 16;         ///< [px] Of a Gaussian of 5.3 px; the taps of wider ones are cut off.
  using Row = std::array<float, kAcross>;
  using Rows = std::array<Row, kDown>;
  /// Pixels of a row with those that are needed at either side, in whole vectors.
  static constexpr int pastRow(int radius) { return (kAcross + 2 * radius + 7) / 8 * 8; }
};

/// Grey levels 0..255 of a block, smoothed along its rows and across them. @param rows kDown + 2 * radius rows of
/// pastRow(radius) pixels, the first one `radius` px above and left of the block, in 1 / 257 grey.
/// @param kernel its half, as of gaussianKernel(); radius + 1 taps.
void smoothBlock(const std::uint16_t* const* rows, std::span<const float> kernel, LevelBlock::Rows& out);

/// Values of a row of a block between the centres of cells of 8 or 16 px: bilinear. @param above, below from the cell
/// before the block's first on, to the one behind its last; `share` of the latter.
void fillBetweenCells(const float* above, const float* below, float share, int cellPx, LevelBlock::Row& out);

/// The values first + slope * (begin + i).
void fillStraight(float first, float slope, int begin, LevelBlock::Row& out);

/// What the weaker level asks for: a part of the contrast, at least the limit, never more than the contrast itself.
struct FaintContrast {
  float reach, limit;  ///< [-] part of the contrast; [grey]
  /// Greatest and least alone, in this order of operands: only then are loops of it made ones of vectors.
  float of(float contrast) const {
    const float share = reach * contrast;
    const float weaker = contrast > share ? contrast : share;  // bright levels are not made weaker
    const float capped = weaker < limit ? weaker : limit;
    return contrast > capped ? contrast : capped;
  }
};

/// The levels of a row of a block: the paper's grey, and what is added to it.
struct RowLevels {
  LevelBlock::Row paper, contrast, certain;
};

/// Which pixels are darker than which level, the first one in the lowest bit.
struct RowBits {
  std::uint32_t ink, certain, faint;
};
RowBits compareRow(const LevelBlock::Row& grey, const RowLevels& levels, const FaintContrast& faint);

}  // namespace batten
