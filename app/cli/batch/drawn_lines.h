// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::cli {

/// Lines for a small picture: points as shares of the page's width and height, from the upper left.
struct DrawnLines {
  double aspect = 1.0;                   ///< Width over height of the page.
  std::vector<std::vector<Vec2>> lines;  ///< 0..1 on the page.
};

/// The curves of an output of ours, .json or .svg, near enough for a picture of a few hundred pixels; no lines if it
/// cannot be read.
DrawnLines drawnLines(const std::string& output);

}  // namespace batten::cli
