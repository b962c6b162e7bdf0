// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/core.hpp>

#include "core/contour/centreline_graph.h"
#include "core/contour/centreline_mask.h"
#include "core/contour/centreline_refine.h"
#include "core/contour/centreline_skeleton.h"
#include "core/contour/stroke_merge.h"

namespace batten {
namespace {

constexpr double kGrainLimit = 0.045;    // [-] grainAlong() above: pencil
constexpr double kShortestWidths = 3.0;  // [stroke widths] shorter strands are blots

std::vector<Strand> strandsOf(const BitImage& ink, const EdgeParams& params, const RunContext& context) {
  BitImage skeleton = ink;
  if (!thinToSkeleton(skeleton, context)) return {};
  return findStrands(skeleton, ink, params, context);
}

// [px] median over all points.
double medianWidth(const std::vector<Strand>& strands) {
  std::vector<float> radii;
  for (const Strand& s : strands) {
    for (const StrandPoint& p : s.points) radii.push_back(p.radius);
  }
  if (radii.empty()) return 1.0;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return std::max(1.0, 2.0 * static_cast<double>(*middle));
}

// Ink that touches the border of the page nearly all along is the margin of the scanner or the edge of the sheet.
bool isMargin(const Contour& c, const GreyImage& grey) {
  constexpr double kTouchPx = 2.0, kMostly = 0.7;
  std::size_t touching = 0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const Vec2& p = c.points[i];
    const double toBorder = std::min({p.x(), p.y(), grey.width - p.x(), grey.height - p.y()});
    if (toBorder <= 0.5 * c.widthPx[i] + kTouchPx) ++touching;
  }
  return static_cast<double>(touching) >= kMostly * static_cast<double>(c.points.size());
}

Result<ContourSet> traceStrokes(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                                const RunContext& context) {
  std::vector<Strand> strands = strandsOf(strokes, params, context);
  if (context.isCancelled()) return cancelled();
  const double width = medianWidth(strands);
  RefineSettings settings;
  BitImage closed;
  const BitImage* ink = &strokes;
  if (grainAlong(strands, grey) > kGrainLimit) {
    // The specks of a pencil become one body first; the middle of its darkness is the line.
    closed = closeInk(strokes, 0.75 * width + 1.0);
    ink = &closed;
    strands = strandsOf(closed, params, context);
    settings.rule = CentreRule::Centroid;
    settings.smoothShiftPx = 3.0;
  }
  if (!params.subpixel) settings.rule = CentreRule::None;
  bridgeGaps(strands, *ink, params, context);
  if (context.isCancelled()) return cancelled();
  ContourSet set;
  set.report.found = static_cast<int>(strands.size());
  std::erase_if(strands,
                [](const Strand& s) { return s.points.size() < 3 || s.length() < kShortestWidths * s.widthPx(); });
  set.report.droppedShort = set.report.found - static_cast<int>(strands.size());
  set.contours = refineStrands(strands, grey, settings, context);
  if (context.isCancelled()) return cancelled();
  std::erase_if(set.contours, [](const Contour& c) { return c.points.size() < 3; });
  if (params.mergeWidths * width >= 1.0) {
    // Between middles: the paper between two strokes is a width less.
    set.contours = mergeStrokes(set.contours, (params.mergeWidths + 1.0) * width, context);
    if (context.isCancelled()) return cancelled();
  }
  set.report.droppedMargins =
      static_cast<int>(std::erase_if(set.contours, [&](const Contour& c) { return isMargin(c, grey); }));
  return set;
}

}  // namespace

Result<ContourSet> centrelines(const BitImage& strokes, const GreyImage& grey, const EdgeParams& params,
                               const RunContext& context) {
  if (strokes.width <= 0 || strokes.height <= 0) return ContourSet{};
  if (grey.width != strokes.width || grey.height != strokes.height) {
    return fail(ErrorCode::BadParameter, "The mask and the scan differ in size.");
  }
  try {
    return traceStrokes(strokes, grey, params, context);
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to find the centre lines.", e.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to find the centre lines.");
  }
}

}  // namespace batten
