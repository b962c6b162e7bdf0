// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

struct ColouredInk {
  GreyImage grey;
  std::int64_t pixels = 0;  ///< Made darker, a rim of 2 px around the ink among them.
};

/// Coloured ink as dark as the channel that shows it best: yellow marker is as bright as paper in the grey, but dark in
/// blue. Each channel is divided by its paper and the darkest taken, for pieces of coloured ink that gain a quarter of
/// contrast or more. Not for areas coloured in within dark lines, which would swallow the lines, nor for the coloured
/// fringes of dark lines: both lie against dark ink along a quarter of their border or more. Nor for light of another
/// colour, which fades in without an edge. Everything else keeps its grey, bit by bit.
/// @return absent: no coloured ink gains, the grey stays as it is; or the run was cancelled.
std::optional<ColouredInk> darkenColouredInk(const GreyImage&, const ColourImage&, const RunContext&);

}  // namespace batten
