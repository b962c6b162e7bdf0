// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contour/contour_set.h"
#include "core/contour/edge_params.h"

namespace batten {

/// Parameters in pixels of a fine page (fine_page.h).
EdgeParams onFinePage(EdgeParams);
ContourParams onFinePage(ContourParams);

/// Lines of a fine page, their outlines not refined yet, in pixels of the page: about one point a pixel.
ContourSet fromFinePage(ContourSet);

}  // namespace batten
