// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/run_context.h"
#include "core/construct/typical/typical_path.h"
#include "core/construct/typical/typical_path_fit.h"

namespace batten {

/// Where the curvature of a typical curve is largest, as its parameter; it may lie outside 0..1.
double placeOfMaximum(const PathElement&);

enum class PathSearch {
  Full,      ///< Elements are divided where the points ask for it, extrema dropped that these do not prove, the rest
             ///< joined.
  Tidy,      ///< Grown: extrema dropped that the points do not prove, neighbours joined; nothing divided.
  Simplify,  ///< The path has the right extrema and trends already: only joined where that costs nothing.
  Keep,      ///< The elements are the user's: only fitted and made monotone.
};

/// The path with as few elements as the points ask for (Bayesian information), every typical curve monotone, and no
/// extremum of curvature that the points do not prove. The noise of the points and where outliers begin are found from
/// the first fit. Absent where the path cannot be fitted.
std::optional<FittedPath> fitTypicalStructure(TypicalPath path, PathData data, PathSearch search,
                                              const RunContext& context);

}  // namespace batten
