// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/bit_disc.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

/// Up and down to the next whole number, as std::ceil() and std::floor(), without a call. @pre it is an int.
int wholeAbove(double value) {
  const int whole = static_cast<int>(value);
  return whole + (whole < value ? 1 : 0);
}
int wholeBelow(double value) {
  const int whole = static_cast<int>(value);
  return whole - (whole > value ? 1 : 0);
}

/// Calls `body(run)` for the rows of a disc, clipped to the picture, until it returns true.
template <class Body>
bool forRowsOfDisc(const BitImage& image, const Vec2& at, double radius, const Body& body) {
  const int y0 = std::max(0, wholeBelow(at.y() - radius));
  const int y1 = std::min(image.height - 1, wholeAbove(at.y() + radius));
  for (int y = y0; y <= y1; ++y) {
    const double dy = y + 0.5 - at.y(), rest = radius * radius - dy * dy;
    if (rest < 0.0) continue;
    const double half = std::sqrt(rest);
    const int x0 = std::max(0, wholeAbove(at.x() - half - 0.5));
    const int x1 = std::min(image.width, wholeBelow(at.x() + half - 0.5) + 1);
    if (x0 < x1 && body(InkRun{y, x0, x1})) return true;
  }
  return false;
}

}  // namespace

void setDisc(BitImage& image, const Vec2& at, double radius) {
  constexpr std::uint64_t kAll = ~std::uint64_t{0};  // a word of pixels
  forRowsOfDisc(image, at, radius, [&](const InkRun& run) {
    const int first = run.x0 >> 6, last = (run.x1 - 1) >> 6;
    std::uint64_t* row = image.row(run.y);
    const std::uint64_t from = kAll << (run.x0 & 63), to = kAll >> (63 - ((run.x1 - 1) & 63));
    if (first == last) {
      row[first] |= from & to;
      return false;
    }
    row[first] |= from;
    for (int i = first + 1; i < last; ++i) row[i] = kAll;
    row[last] |= to;
    return false;
  });
}

bool anyInDisc(const BitImage& image, const Vec2& at, double radius) {
  return forRowsOfDisc(image, at, radius, [&](const InkRun& run) { return countBits(image, run) > 0; });
}

}  // namespace batten
