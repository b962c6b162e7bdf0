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
  const RunPieces found = findPieces(image, connectivity, context);
  std::vector<std::int64_t> area(found.runs.size(), 0);
  for (std::size_t i = 0; i < found.runs.size(); ++i) area[found.piece[i]] += found.runs[i].x1 - found.runs[i].x0;
  return static_cast<int>(std::count_if(area.begin(), area.end(),
                                        [&](std::int64_t a) { return a > 0 && static_cast<double>(a) < areaPx; }));
}

}  // namespace

InkGrain measureGrain(const BitImage& ink, const RunContext& context) {
  const std::int64_t area = ink.count(), border = area - shrunken(ink, 1, context).count();
  if (border <= 0 || context.isCancelled()) return {};
  InkGrain grain;
  grain.widthPx = 2.0 * static_cast<double>(area) / static_cast<double>(border);
  const double square = grain.widthPx * grain.widthPx;
  const int specks = smallerPieces(ink, Connectivity::Eight, square, context);
  const int holes = smallerPieces(paperOf(ink), Connectivity::Four, square, context);
  grain.perWidth = (specks + holes) * grain.widthPx / (0.5 * static_cast<double>(border));
  return grain;
}

}  // namespace batten
