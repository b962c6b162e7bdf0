// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// One dot of dotted paper.
struct PrintedDot {
  Vec2 atPx{0.0, 0.0};                   ///< Its middle, image frame.
  double widthPx = 0.0, heightPx = 0.0;  ///< At half of its depth.
  bool isAlone = false;                  ///< No stroke near by.
};

/// Finds the dots of dotted paper: small, round and alike, on one lattice over the page, also where it is rotated,
/// curls or is seen in perspective. They are more even than a hand places them: each lies in the middle between its
/// neighbours, and hardly a place of the lattice is bare paper. Dots of a drawing, as stippling, buttons and dotted
/// lines, cover less of the page, are less even or lie closer together. Empty where nothing else is on the page: then
/// they were drawn; or when cancelled.
std::vector<PrintedDot> findDotGrid(const GreyImage&, const RunContext&);

/// The page with the paper around each dot in its place. A dot that a stroke runs over stays.
GreyImage withoutDots(GreyImage, const std::vector<PrintedDot>&);

}  // namespace batten
