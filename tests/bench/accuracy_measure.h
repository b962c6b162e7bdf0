// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/pipeline/pipeline.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {

/// How a run compares with the truth. Lengths in px of the scan.
struct Accuracy {
  bool found = false;  ///< At least 95 % of the smooth outline has a curve within 2 px.
  double rmsPx = 0.0;  ///< Of the curve from the truth, away from corners.
  double maxPx = 0.0;
  double curvatureError = 0.0;  ///< rms of (kappa - truth) times the diagonal of the shape, away from corners.
  int extrema = 0;              ///< Of the curves, prominence 5e-3 / diagonal.
  int trueExtrema = 0;
  double cornerRmsPx = 0.0;  ///< 0 without corners.
  double cornerMaxPx = 0.0;
  int cornersFound = 0;
  int cornersTrue = 0;
  int controlPoints = 0;
  double milliseconds = 0.0;
  std::string failure;  ///< Message of the pipeline if it ended early.
};

struct AccuracyCase {
  bool faired = false;             ///< Measure the faired curves instead of the sketched ones.
  double cornerClickOffsetPx = 8;  ///< Corners are marked by clicks this far from the truth.
};

/// Runs the pipeline on a page that shows `shape`, corners marked by clicks, and measures the result.
Accuracy measureAccuracy(const TruthShape& shape, const Scan& scan, Recipe recipe, const AccuracyCase& options);

}  // namespace batten::test
