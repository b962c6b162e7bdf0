// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/ink_grain.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

int smallerPieces(const BitImage& image, Connectivity connectivity, double areaPx, const RunContext& context) {
  const std::vector<std::int64_t> area = areasOfPieces(findPieces(image, connectivity, context));
  return static_cast<int>(std::count_if(area.begin(), area.end(),
                                        [&](std::int64_t a) { return a > 0 && static_cast<double>(a) < areaPx; }));
}

}  // namespace

InkGrain measureGrain(const BitImage& ink, const RunContext& context) {
  InkCounts counts{ink.count()};
  counts.border = counts.area - shrunken(ink, 1, context).count();
  if (counts.border <= 0 || context.isCancelled()) return {};
  const double square = counts.widthPx() * counts.widthPx();
  counts.small = smallerPieces(ink, Connectivity::Eight, square, context) +
                 smallerPieces(paperOf(ink), Connectivity::Four, square, context);
  return {counts.widthPx(), counts.grain()};
}

}  // namespace batten
