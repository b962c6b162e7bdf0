// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/colour/ink_look.h"

#include <algorithm>

namespace batten {
namespace {

constexpr float kLeastDarkness = 0.12f;  // of the paper's light in the darkest channel: less is paper
constexpr float kColourful = 0.22f;      // share of the darkness that the channels differ by

/// @param light what of the paper's light comes through, per channel.
InkLook lookAt(const std::array<float, 3>& light) {
  const float most = std::max({light[0], light[1], light[2]}), least = std::min({light[0], light[1], light[2]});
  InkLook look;
  look.darkness = 1.0f - least;
  if (look.darkness < kLeastDarkness) return look;
  look.kind = InkKind::Neutral;
  const float spread = most - least;
  if (spread < kColourful * look.darkness) return look;
  look.kind = InkKind::Hued;
  float sixth;
  if (most == light[0])
    sixth = (light[1] - light[2]) / spread;
  else if (most == light[1])
    sixth = 2.0f + (light[2] - light[0]) / spread;
  else
    sixth = 4.0f + (light[0] - light[1]) / spread;
  look.hueDeg = 60.0f * (sixth < 0.0f ? sixth + 6.0f : sixth);
  return look;
}

}  // namespace

void LookReader::setRow(int y) {
  y_ = y;
  paper_.ratiosOfRow(y, width_, height_, ratios_);
}

InkLook LookReader::at(int x, const Rgb8& c) const {
  const float light = std::max(1.0f, paper_.levelAt(x, y_));
  return lookAt({std::min(1.0f, static_cast<float>(c.red) / (ratios_[0][x] * light)),
                 std::min(1.0f, static_cast<float>(c.green) / (ratios_[1][x] * light)),
                 std::min(1.0f, static_cast<float>(c.blue) / (ratios_[2][x] * light))});
}

}  // namespace batten
