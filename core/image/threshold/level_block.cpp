// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/level_block.h"

#include <algorithm>

#include "core/base/hot_loop.h"
#include "core/image/bits/packed_flags.h"
#include "core/image/grey_image.h"

namespace batten {
namespace {

constexpr int kAcross = LevelBlock::kAcross, kDown = LevelBlock::kDown;          // px
constexpr float kGreyPerValue = static_cast<float>(1.0 / GreyImage::kGreyUnit);  // to grey levels 0..255

/// With a radius that the compiler knows the sums stay in registers. The order of the sums is that of smooth().
template <int Radius>
BATTEN_PART_OF_LOOP void smoothBlockBody(const std::uint16_t* const* rows, const float* taps, int anyRadius,
                                         LevelBlock::Rows& out) {
  const int radius = Radius > 0 ? Radius : anyRadius, rowCount = kDown + 2 * radius;
  std::array<float, LevelBlock::kMostRadius + 1> kernel;  // nothing that is written could be among these
  for (int k = 0; k <= radius; ++k) kernel[k] = taps[k];
  // All rows of one step before the next: what has just been written cannot be read at other places without waiting.
  std::array<std::array<float, LevelBlock::pastRow(LevelBlock::kMostRadius)>, kDown + 2 * LevelBlock::kMostRadius> grey;
  std::array<LevelBlock::Row, kDown + 2 * LevelBlock::kMostRadius> along;
  for (int y = 0; y < rowCount; ++y) {
    const std::uint16_t* in = rows[y];
    for (int i = 0; i < LevelBlock::pastRow(radius); ++i) grey[y][i] = static_cast<float>(in[i]) * kGreyPerValue;
  }
  for (int y = 0; y < rowCount; ++y) {
    for (int i = 0; i < kAcross; ++i) {
      const float* at = grey[y].data() + radius + i;
      float sum = kernel[0] * at[0];
      for (int k = 1; k <= radius; ++k) sum += kernel[k] * (at[-k] + at[k]);
      along[y][i] = sum;
    }
  }
  for (int y = 0; y < kDown; ++y) {
    for (int i = 0; i < kAcross; ++i) {
      float sum = kernel[0] * along[y + radius][i];
      for (int k = 1; k <= radius; ++k) sum += kernel[k] * (along[y + radius - k][i] + along[y + radius + k][i]);
      out[y][i] = sum;
    }
  }
}

BATTEN_HOT_LOOP void smoothBlockOf(const std::uint16_t* const* rows, const float* kernel, int radius,
                                   LevelBlock::Rows& out) {
  switch (radius) {
    case 1:
      return smoothBlockBody<1>(rows, kernel, radius, out);
    case 3:
      return smoothBlockBody<3>(rows, kernel, radius, out);
    case 5:
      return smoothBlockBody<5>(rows, kernel, radius, out);
    case 6:
      return smoothBlockBody<6>(rows, kernel, radius, out);
    default:
      return smoothBlockBody<0>(rows, kernel, radius, out);
  }
}

template <int Cell>
BATTEN_PART_OF_LOOP void betweenCells(const float* above, const float* below, float share, float* out) {
  constexpr int kHalfCell = Cell / 2, kCells = kAcross / Cell;  // values lie in the middles of cells
  std::array<float, kCells + 2> column;
  for (int c = 0; c < kCells + 2; ++c) column[c] = above[c] + share * (below[c] - above[c]);
  constexpr float kStep = 1.0f / static_cast<float>(Cell);  // of one pixel, between two cells
  for (int c = 0; c <= kCells; ++c) {
    const float left = column[c], slope = (column[c + 1] - left) * kStep;
    float* to = out + (c * Cell - kHalfCell);
    if (c > 0)
      for (int k = 0; k < kHalfCell; ++k) to[k] = left + slope * (static_cast<float>(k) + 0.5f);
    if (c < kCells)
      for (int k = kHalfCell; k < Cell; ++k) to[k] = left + slope * (static_cast<float>(k) + 0.5f);
  }
}

BATTEN_HOT_LOOP void fillBetween(const float* above, const float* below, float share, int cellPx,
                                 float* __restrict out) {
  if (cellPx == 8)
    betweenCells<8>(above, below, share, out);
  else
    betweenCells<16>(above, below, share, out);
}

BATTEN_HOT_LOOP void fillFrom(float first, float slope, int begin, float* __restrict out) {
  for (int i = 0; i < kAcross; ++i) out[i] = first + slope * static_cast<float>(begin + i);
}

struct FlagsOfRow {
  std::array<std::uint8_t, kAcross> ink, certain, faint;
};

BATTEN_HOT_LOOP void flagRow(const LevelBlock::Row& grey, const RowLevels& levels, float reach, float limit,
                             FlagsOfRow& __restrict out) {
  for (int i = 0; i < kAcross; ++i) out.ink[i] = grey[i] < levels.paper[i] + levels.contrast[i] ? 1 : 0;
  for (int i = 0; i < kAcross; ++i) out.certain[i] = grey[i] < levels.paper[i] + levels.certain[i] ? 1 : 0;
  for (int i = 0; i < kAcross; ++i)
    out.faint[i] = grey[i] < levels.paper[i] + FaintContrast{reach, limit}.of(levels.contrast[i]) ? 1 : 0;
}

std::uint32_t packedOf(const std::array<std::uint8_t, kAcross>& flags) {
  std::uint64_t word = 0;
  packFlags(flags.data(), kAcross, &word);
  return static_cast<std::uint32_t>(word);
}

}  // namespace

void smoothBlock(const std::uint16_t* const* rows, std::span<const float> kernel, LevelBlock::Rows& out) {
  smoothBlockOf(rows, kernel.data(), std::min(static_cast<int>(kernel.size()) - 1, LevelBlock::kMostRadius), out);
}

void fillBetweenCells(const float* above, const float* below, float share, int cellPx, LevelBlock::Row& out) {
  fillBetween(above, below, share, cellPx, out.data());
}

void fillStraight(float first, float slope, int begin, LevelBlock::Row& out) {
  fillFrom(first, slope, begin, out.data());
}

RowBits compareRow(const LevelBlock::Row& grey, const RowLevels& levels, const FaintContrast& faint) {
  FlagsOfRow flags;
  flagRow(grey, levels, faint.reach, faint.limit, flags);
  return {packedOf(flags.ink), packedOf(flags.certain), packedOf(flags.faint)};
}

}  // namespace batten
