// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "core/base/run_context.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// A page as lines on the tones of a pencil are searched on.
struct PencilPage {
  cv::Mat1f level;             ///< [of 255] Brightness of the paper's.
  cv::Mat1b smooth, ground;    ///< The same without its grain; without what is narrower than the brush, too.
  PaperBackground paper;       ///< What they are measured against.
  double widthPx = 0.0;        ///< Of thin lines, 2.4 to 4.
  int brush = 0;               ///< [px] Radius of one that no thin line holds.
  double darkness = 0.0;       ///< [of 255] Of lines.
  double darknessAlike = 1.0;  ///< 0..1 The darkness of a faint part of the ink's middle lines by that of a dark one.
};
/// Absent: there is no ink, or cancelled.
std::optional<PencilPage> lookAtPencil(const GreyImage&, const RunContext&);

/// Lines on what is shaded and near it, about as broad as they are, not 0: long and darker than both sides along them,
/// by more than the grain of the tone explains. Unfinished when cancelled.
cv::Mat1b linesOnTones(const PencilPage&, const cv::Mat1b& shaded, const RunContext&);
/// [of 255] The brightness of the middle of lines, everywhere that of the nearest one. @pre there is one
cv::Mat1b levelOfLines(const PencilPage&, const cv::Mat1b& lines);

cv::Mat1b roundedTone(const cv::Mat1f& picture);

}  // namespace batten
