// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/image/grey_image.h"
#include "core/image/threshold/paper_fold.h"

namespace batten {

inline constexpr int kFoldPaperPx = 8;         ///< [px] of paper on either side of a fold that says its level.
inline constexpr double kLeastFoldStep = 4.0;  ///< [grey]

/// Grey along normals of a course: rows of 2 * half + 1 values, one row every `stepPx`.
struct FoldStrip {
  int half = 0, rows = 0;   ///< [px] to either side of the course; rows.
  double stepPx = 2.0;      ///< Between rows.
  std::vector<float> grey;  ///< [grey] Row by row.
  const float* row(int i) const { return grey.data() + std::ptrdiff_t{i} * (2 * half + 1); }
  /// Mean over d in [from, to] of row i.
  double mean(int i, int from, int to) const {
    double sum = 0.0;
    for (int d = from; d <= to; ++d) sum += static_cast<double>(row(i)[d + half]);
    return sum / (to - from + 1);
  }
};

/// One row every `stepPx`. Where a row of the strip leaves the page its values repeat the border.
FoldStrip foldStripAlong(const GreyImage& image, const FoldCourse& course, int half, double stepPx);

/// A step that changes linearly along the course, and which rows of the strip show it.
struct FoldStepFit {
  double middle = 0.0, slope = 0.0;  ///< [grey], [grey per row]
  std::vector<std::uint8_t> shows;   ///< Per row: not 0 where the step is seen.
  double at(int i, int rows) const { return middle + slope * (i - 0.5 * rows); }
};

/// Slope of the paper across the course [grey/px], the same on both sides of a step, per row of the strip.
std::vector<double> foldSlopesAcross(const FoldStrip& strip);

/// [grey] How far the brighter side of every row stands above the darker one, the paper's slope across taken out.
/// @param reach [px] from the course to where the paper is undisturbed.
std::vector<double> foldStepsOf(const FoldStrip& strip, int reach, const std::vector<double>& slopes);

/// The line through the steps that most of them are near; nothing if too few are, or the step is too small.
std::optional<FoldStepFit> fitFoldStep(const std::vector<double>& steps);

/// [px] From the middle of the step to where the paper is undisturbed on either side; nothing if it is no step.
std::optional<int> foldReachOf(const FoldStrip& strip, const FoldStepFit& fit);

}  // namespace batten
