// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/recipe/scale_line.h"

#include <cmath>

#include "core/base/conventions.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

std::optional<double> resolutionOf(const ScaleLine& line) {
  const double dpi = (line.toPx - line.fromPx).norm() * kMillimetresPerInch / line.lengthMm;
  return line.lengthMm > 0.0 && std::isfinite(dpi) && dpi > 0.0 ? std::optional(dpi) : std::nullopt;
}

void setScaleLine(Recipe& recipe, const ScaleLine& line) {
  recipe.scaleLine = line;
  recipe.dpi = resolutionOf(line);
}

void setResolution(Recipe& recipe, std::optional<double> dpi) {
  recipe.scaleLine.reset();
  recipe.dpi = dpi;
}

}  // namespace batten
