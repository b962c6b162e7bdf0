// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/rectification.h"
#include "core/image/scan.h"
#include "core/image/sheet/paper_sheet.h"

namespace batten {

/// How the sheet lies on the picture, and what rectifying it would change.
struct SheetView {
  Rectification rectification;  ///< By its corners.
  double convergenceDeg = 0.0;  ///< Angle between opposite sides, of the pair that is farther from parallel.
  double skewDeg = 0.0;         ///< By how much the corner farthest from a right angle misses it.
  /// Whether lines of the drawing are bent out of true enough to be seen.
  bool isAngled() const;
  /// "a right angle is seen as 84.2°, parallel sides converge by 3.1°".
  std::string text() const;
};

/// Absent where its four corners are not on the picture, or an edge is not clearly seen.
std::optional<SheetView> sheetView(const Scan&, const PaperSheet&, const RunContext&);

/// The page that these corners make of the picture.
/// @return BadParameter if a corner lies too far outside the picture.
Result<Rectification> rectificationOf(const Scan&, const SheetCorners&, PaperFormat);

/// The scan with its sheet made a rectangle, at the resolution of its nearest part: for all that follows this is the
/// scan. With `Off` it is returned as it is; with `Automatic` too where no sheet with four edges is found, with the
/// reason in Scan::rectifyNote. The same pixels with any number of threads.
/// @return BadParameter for corners that are none of a sheet on this picture, OutOfMemory, Cancelled.
Result<Scan> rectified(Scan&&, const RectifyParams&, const RunContext&);
/// The same from a scan that is still needed.
Result<Scan> rectified(const Scan&, const RectifyParams&, const RunContext&);
/// Whether a scan is what rectified() makes with these parameters.
bool isRectifiedAs(const Scan&, const RectifyParams&);

}  // namespace batten
