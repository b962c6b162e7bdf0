// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/contour/intent/strips.h"

namespace batten {

/// The shares of strips. @param merged lines merged over the page as a whole (stroke_merge.h), px. @param reach [stroke
/// widths] how far a stroke lies from the line that it was merged into.
std::vector<MergeShares> mergeSharesOf(const std::vector<Strip>& strips, const std::vector<Contour>& merged,
                                       double widthPx, double reach, const RunContext& context);

/// [-] 0..1 of two strips that lies on the same lines.
double alikeness(const MergeShares& a, const MergeShares& b);
/// [-] 0..1 of a strip that lies on a line at all.
double coverage(const MergeShares& a);
/// What log-odds take of it: alikeness, that as a factor of `number`, and whether both lie on lines that differ.
std::vector<double> mergeFeatures(const MergeShares& a, const MergeShares& b, double number);

}  // namespace batten
