// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/hatching_page.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/base/vec2.h"
#include "core/image/plane.h"

namespace batten::test {
namespace {

constexpr int kHatchedWidth = 600, kHatchedHeight = 400;

Vec2 hatchDirection(double angleDeg) {
  const double angle = angleDeg * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle)};
}

bool isOnHatch(const Vec2& at, const Vec2& direction, const Hatching& h) {
  const double away = direction.x() * at.y() - direction.y() * at.x() - h.offsetPx;
  return std::fabs(away - h.spacingPx * std::floor(away / h.spacingPx + 0.5)) < 0.5 * h.widthPx;
}

}  // namespace

GreyImage hatchingPage(const Hatching& h) {
  constexpr int kParts = 8;  // of a pixel, along a side
  const Vec2 along = hatchDirection(h.angleDeg);
  Plane plane(kHatchedWidth, kHatchedHeight);
  for (int y = 0; y < kHatchedHeight; ++y) {
    for (int x = 0; x < kHatchedWidth; ++x) {
      int inked = 0;
      for (int part = 0; part < kParts * kParts; ++part) {
        const Vec2 at(x + (part % kParts + 0.5) / kParts, y + (part / kParts + 0.5) / kParts);
        inked += isOnHatch(at, along, h) ? 1 : 0;
      }
      plane.row(y)[x] = 235.0f - 215.0f * static_cast<float>(inked) / (kParts * kParts);
    }
  }
  if (h.blurPx > 0.0) plane = smooth(plane, gaussianKernel(h.blurPx * h.blurPx), {});
  GreyImage page(kHatchedWidth, kHatchedHeight);
  for (int y = 0; y < kHatchedHeight; ++y) {
    for (int x = 0; x < kHatchedWidth; ++x)
      page.row(y)[x] = static_cast<std::uint16_t>(257 * std::lround(plane.row(y)[x]));
  }
  return page;
}

int linesOnPage(const Hatching& h, double leastPx) {
  const Vec2 along = hatchDirection(h.angleDeg);
  const auto count = static_cast<int>(std::hypot(kHatchedWidth, kHatchedHeight) / h.spacingPx) + 1;
  int lines = 0;
  for (int k = -count; k <= count; ++k) {
    const Vec2 at = (h.offsetPx + k * h.spacingPx) * Vec2(-along.y(), along.x());
    double from = -1e9, to = 1e9;
    for (const auto& [place, step, size] :
         {std::tuple(at.x(), along.x(), double{kHatchedWidth}), {at.y(), along.y(), double{kHatchedHeight}}}) {
      if (std::fabs(step) < 1e-9) {
        if (place < 0.0 || place > size) to = from;
        continue;
      }
      const double a = -place / step, b = (size - place) / step;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    lines += to - from > leastPx ? 1 : 0;
  }
  return lines;
}

}  // namespace batten::test
