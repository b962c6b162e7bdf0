// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/contour/contour_set.h"
#include "core/image/bits/bit_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Which short lines of a page are nothing but the grain of a tone: where the tooth of the paper takes more of the
/// pencil, smooth shading crosses the threshold in dashes of any direction. Such a line is all of this:
/// - hardly darker than its ground varies, or of many such lines the darkest. How the ground varies is measured on the
///   bright side, where grain shows and ink does not: on clean paper everything stands out, however closely it is
///   drawn. Where the scanner has made the paper of a pencil white, nothing of its grain is left to measure but such
///   lines, and those far fainter than the long ones count;
/// - fainter against what lies beside it than the long lines of the page, as ink is that a threshold between them and
///   the paper would not find;
/// - not straight over a length that chance does not lead it;
/// - without company: it does not run as the lines around it do (line_company.h) that are no grain themselves.
/// Marks that are followed along their border are another rule's (faint_marks.h).
/// @return for each contour whether it is grain. None is where the page has no long lines, and where a line has no
/// ground around it that is not a shape.
/// @param isPencil most of the page was drawn with a pencil: a faint line of a pen is no grain.
std::vector<bool> linesOfGrain(const ContourSet& set, const GreyImage& grey, bool isPencil, const RunContext& context);

/// Drops such lines and counts them in the report, but for those on ink that the user painted.
void dropGrain(ContourSet& set, const GreyImage& grey, bool isPencil, const std::optional<BitImage>& painted,
               const RunContext& context);

}  // namespace batten
