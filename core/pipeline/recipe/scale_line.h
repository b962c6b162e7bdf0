// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/vec2.h"

namespace batten {

struct Recipe;

/// Two places of the page whose distance is known: where the resolution comes from.
struct ScaleLine {
  Vec2 fromPx = Vec2::Zero(), toPx = Vec2::Zero();
  double lengthMm = 0.0;  ///< [mm] > 0. Their true distance.
  bool operator==(const ScaleLine& o) const { return fromPx == o.fromPx && toPx == o.toPx && lengthMm == o.lengthMm; }
};

/// [dpi] The resolution that a line makes; absent for one without length.
std::optional<double> resolutionOf(const ScaleLine&);

/// Gives a recipe the line and the resolution that follows. @pre resolutionOf(line)
void setScaleLine(Recipe&, const ScaleLine& line);
/// Gives a recipe a resolution (absent: the file's) from elsewhere; a line that said another one goes.
void setResolution(Recipe&, std::optional<double> dpi);

}  // namespace batten
