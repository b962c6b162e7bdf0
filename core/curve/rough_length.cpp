// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/curve/rough_length.h"

namespace batten {

double roughLength(const NurbsCurve& curve, double from, double to) {
  constexpr int kChords = 8;  // a quarter of a circle comes out 0.2 % too short
  double length = 0.0;
  Vec2 last = curve.point(from);
  for (int i = 1; i <= kChords; ++i) {
    const Vec2 next = curve.point(from + (to - from) * i / kChords);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

}  // namespace batten
