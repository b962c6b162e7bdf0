// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/darkest_cells.h"

#include <algorithm>
#include <array>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"

namespace batten {
namespace {

using RowsOfCell = std::array<const std::uint16_t*, DarkestCells::kDown>;

std::uint16_t lesser(std::uint16_t a, std::uint16_t b) { return a < b ? a : b; }

BATTEN_HOT_LOOP void lowestOfRows(const RowsOfCell& rows, std::uint16_t* __restrict out, int count) {
  const std::uint16_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
  for (int i = 0; i < count; ++i) out[i] = lesser(lesser(a[i], b[i]), lesser(c[i], d[i]));
}

/// The lesser of every value and the one `apart` places on.
BATTEN_HOT_LOOP void lowestOfPairs(const std::uint16_t* in, std::uint16_t* __restrict out, int count, int apart) {
  for (int i = 0; i < count; ++i) out[i] = lesser(in[i], in[i + apart]);
}

}  // namespace

BATTEN_HOT_LOOP void takeLesser(const std::uint16_t* in, std::uint16_t* out, int count) {
  for (int i = 0; i < count; ++i) out[i] = lesser(in[i], out[i]);
}

DarkestCells::DarkestCells(const GreyImage& image, const RunContext& context)
    : columns_((image.width + kAcross - 1) / kAcross),
      rows_((image.height + kDown - 1) / kDown),
      lowest_(std::ptrdiff_t{columns_} * rows_) {
  parallelFor(context, rows_, kRowsPerBlock / kDown, [&](int begin, int end) {
    // What lies beyond the page is white.
    const int padded = columns_ * kAcross;
    std::vector<std::uint16_t> one(padded, 0xffff), two(padded);
    for (int row = begin; row < end; ++row) {
      RowsOfCell rows;
      for (int i = 0; i < kDown; ++i) rows[i] = image.row(std::min(row * kDown + i, image.height - 1));
      lowestOfRows(rows, one.data(), image.width);
      std::fill(one.begin() + image.width, one.end(), std::uint16_t{0xffff});
      lowestOfPairs(one.data(), two.data(), padded - 1, 1);
      lowestOfPairs(two.data(), one.data(), padded - 3, 2);
      std::uint16_t* out = lowest_.data() + std::ptrdiff_t{row} * columns_;
      for (int i = 0; i < columns_; ++i) out[i] = lesser(one[i * kAcross], one[i * kAcross + 4]);
    }
  });
}

}  // namespace batten
