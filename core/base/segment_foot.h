// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "core/base/vec2.h"

namespace batten {

/// The place of a segment that is nearest to a point.
struct SegmentFoot {
  double share = 0.0;        ///< 0..1 from the first end to the second.
  Vec2 away = Vec2::Zero();  ///< The way from the foot to the point.
};

/// The foot of `p` on the segment from `a` to `b`. A segment without length has its foot at `a`.
inline SegmentFoot footOnSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return {share, p - a - share * along};
}

}  // namespace batten
