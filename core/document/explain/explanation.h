// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/bits/bit_image.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// A stretch of a curve that has no ink under it.
struct InventedStretch {
  int curve = 0;             ///< Index into FairedSet::curves.
  double lengthPx = 0.0;     ///< [px] Along the curve.
  std::vector<Vec2> linePx;  ///< Its course, a point about every pixel; at least two.
};

/// [0..1] What the shares of a page are held against: the ink explained, where most of it was drawn with a pen or with
/// a pencil, whose grain fades into the paper; and the length of the curves that is invented.
inline constexpr double kLeastExplainedPen = 0.97, kLeastExplainedPencil = 0.92, kMostInvented = 0.005;

/// How well the curves of a run explain the ink of the page.
struct Explanation {
  /// Ink that the page holds at a low contrast which no setting of the drawing changes, in the regions traced, but for
  /// margins along the border of the page and edges of a sheet. [px]
  std::int64_t referencePx = 0;
  double explained = 1.0;  ///< Share of the reference ink within reach of the curves drawn anew. 0..1
  double missed = 0.0;     ///< The rest of it.
  double curvesPx = 0.0;   ///< Length of all curves found on the scan.
  /// Share of that length out of reach of any reference ink, but for declared bridges and for stretches along which the
  /// page is clearly darker than at both sides, or, of borders, than at one. 0..1
  double invented = 0.0;
  std::vector<InventedStretch> inventions;     ///< Longest first.
  BitImage missedInk;                          ///< Reference ink that no curve explains.
  double leastExplained = kLeastExplainedPen;  ///< What is asked of this page.
  std::string note;                            ///< What misses its limit, for the user; else empty.
  bool isExplained() const { return referencePx == 0 || explained >= leastExplained; }
  bool isInvented() const { return invented > kMostInvented; }  ///< Too much of it.
};

/// Redraws the page from its curves and compares: centre lines with their widths, borders filled where what they
/// enclose is ink. Reach: the larger of 2 px and half the width of the line. Lines drawn with the pen explain ink but
/// cannot be invented. Made after the curves and changes nothing of the run.
/// @return Cancelled; OutOfMemory; what findThresholds says.
Result<Explanation> explainPage(const Scan&, const Recipe&, const PipelineOutput&, const RunContext&);

}  // namespace batten
