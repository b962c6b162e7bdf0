// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>

#include "core/image/rectification.h"
#include "core/pipeline/recipe/recipe.h"

namespace batten {

/// Moves every place of the page that the recipe holds: marks, choices, regions, pen strokes, the scale line, places of
/// numbered curves; painted ink keeps its breadth on the drawing. The resolution and lengths in px that are parameters
/// stay.
/// @param scale pixels of the page moved to, along a pixel of the one before.
void movePlaces(Recipe&, const std::function<Vec2(const Vec2&)>& move, double scale);

/// Numbers of curves on another page of the same picture: on the same ink.
CurveNumbers rectifiedNumbers(CurveNumbers, const std::optional<Rectification>& before,
                              const std::optional<Rectification>& after);

/// The recipe for the page that is rectified in another way, or no more: its places stay on the same ink. A resolution
/// that was measured on the drawing is measured anew; one that was stated is dropped where the new page has its own.
/// @param before, after how the page was and is to be rectified; absent: it is the picture as it was taken.
Recipe rectifiedRecipe(Recipe recipe, const std::optional<Rectification>& before,
                       const std::optional<Rectification>& after, const RectifyParams& params);

}  // namespace batten
