// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/fair/fair_noise.h"
#include "core/construct/fair/fair_posterior.h"
#include "core/construct/fair/fair_simple.h"
#include "core/construct/pieces.h"

namespace batten {

/// One piece of a contour between the steps of the fair fit.
struct FairPiece {
  FairData data;                     ///< px, relative to `origin`.
  Vec2 origin = Vec2::Zero();        ///< px.
  FairPins pins;                     ///< As data.
  std::optional<FairFrame> frame;    ///< About the pilot; absent: too short for the fair fit.
  std::optional<CutoffTable> table;  ///< Absent: without a frame.
  Eigen::VectorXd rough;             ///< Offsets from the pilot by the cut-off of the piece.
  double squares = 0.0;              ///< Of the residuals of single points about the result.
  int pointCount = 0;                ///< How many they are.
  std::optional<Result<ConstructedPiece>> result;
};

}  // namespace batten
