// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/colour/ink_picker.h"

#include <algorithm>
#include <cmath>

#include "core/image/colour/ink_look.h"

namespace batten {
namespace {

Rgb8 meanAround(const ColourImage& colour, int x, int y) {
  int red = 0, green = 0, blue = 0, count = 0;
  for (int v = std::max(0, y - 1); v <= std::min(colour.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(colour.width - 1, x + 1); ++u, ++count) {
      const Rgb8& c = colour.row(v)[u];
      red += c.red;
      green += c.green;
      blue += c.blue;
    }
  }
  const auto mean = [count](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  return {mean(red), mean(green), mean(blue)};
}

}  // namespace

InkPicker::InkPicker(const GreyImage& grey, const ColourImage& colour, const RunContext& context) : colour_(colour) {
  if (!colour.isEmpty()) paper_ = measurePaperColour(grey, colour, context);
}

std::optional<FoundInk> InkPicker::inkAt(const Vec2& px, double reachPx) const {
  if (colour_.isEmpty() || !px.allFinite()) return std::nullopt;
  const int width = colour_.width, height = colour_.height;
  const auto from = [reachPx](double at) { return std::max(0, static_cast<int>(std::floor(at - reachPx))); };
  const auto to = [reachPx](double at, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(std::min(at + reachPx, static_cast<double>(size)))));
  };
  LookReader reader(paper_, width, height);
  std::optional<FoundInk> nearest;
  double least = reachPx * reachPx;
  for (int y = from(px.y()); y <= to(px.y(), height); ++y) {
    reader.setRow(y);
    for (int x = from(px.x()); x <= to(px.x(), width); ++x) {
      const double distance = (Vec2(x + 0.5, y + 0.5) - px).squaredNorm();
      if (distance > least || (nearest && distance == least)) continue;
      const Rgb8 mean = meanAround(colour_, x, y);
      const InkLook look = reader.at(x, mean);
      if (look.kind == InkKind::Paper || look.darkness < kSureDarkness) continue;
      least = distance;
      InkColour ink = look.colour();
      if (ink.hueDeg) ink.hueDeg = std::round(*ink.hueDeg);
      nearest = FoundInk{ink, mean, 0.0};
    }
  }
  return nearest;
}

}  // namespace batten
