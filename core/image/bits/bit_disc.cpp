// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/bit_disc.h"

#include <algorithm>
#include <cmath>

#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

/// Calls `body(run)` for the rows of a disc, clipped to the picture, until it returns true.
template <class Body>
bool forRowsOfDisc(const BitImage& image, const Vec2& at, double radius, const Body& body) {
  const int y0 = std::max(0, static_cast<int>(std::floor(at.y() - radius)));
  const int y1 = std::min(image.height - 1, static_cast<int>(std::ceil(at.y() + radius)));
  for (int y = y0; y <= y1; ++y) {
    const double dy = y + 0.5 - at.y(), rest = radius * radius - dy * dy;
    if (rest < 0.0) continue;
    const double half = std::sqrt(rest);
    const int x0 = std::max(0, static_cast<int>(std::ceil(at.x() - half - 0.5)));
    const int x1 = std::min(image.width, static_cast<int>(std::floor(at.x() + half - 0.5)) + 1);
    if (x0 < x1 && body(InkRun{y, x0, x1})) return true;
  }
  return false;
}

}  // namespace

void setDisc(BitImage& image, const Vec2& at, double radius) {
  forRowsOfDisc(image, at, radius, [&](const InkRun& run) {
    setBits(image, run);
    return false;
  });
}

bool anyInDisc(const BitImage& image, const Vec2& at, double radius) {
  return forRowsOfDisc(image, at, radius, [&](const InkRun& run) { return countBits(image, run) > 0; });
}

}  // namespace batten
