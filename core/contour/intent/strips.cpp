// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/strips.h"

#include "core/polyline/polyline_tools.h"

namespace batten {

std::vector<Vec2> positionsOf(const std::vector<StripSample>& samples) {
  std::vector<Vec2> positions;
  positions.reserve(samples.size());
  for (const StripSample& sample : samples) positions.push_back(sample.at);
  return positions;
}

void setTangents(Strip& strip) {
  constexpr int kTangentReach = 2;  // samples to either side
  const std::vector<Vec2> tangents = directions(positionsOf(strip.samples), strip.closed, kTangentReach);
  for (int i = 0; i < strip.count(); ++i) strip.samples[i].tangent = tangents[i];
}

}  // namespace batten
