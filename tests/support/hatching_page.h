// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/image/grey_image.h"

namespace batten::test {

/// Parallel lines from border to border of a page of 600 x 400.
struct Hatching {
  double angleDeg = 45.0, widthPx = 2.0, spacingPx = 4.0;  ///< Spacing: from middle to middle.
  double offsetPx = 0.0;                                   ///< Of a line's middle from the page's corner.
  double blurPx = 0.0;                                     ///< Standard deviation of a Gaussian.
};

/// Ink 20 on paper 235, of which a pixel shows as much as it holds.
GreyImage hatchingPage(const Hatching&);

/// How many of its lines are longer than this on the page.
int linesOnPage(const Hatching&, double leastPx);

}  // namespace batten::test
