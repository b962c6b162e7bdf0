// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// A place in the middle of a stroke. Model frame, mm.
struct MiddlePlace {
  Vec2 at = Vec2::Zero();
  Vec2 along = Vec2::UnitX();  ///< Unit direction of travel.
  double kappa = 0.0;          ///< [1/mm] signed curvature, positive to the left.
  double width = 0.0;          ///< [mm]
  double growth = 0.0;         ///< [-] change of the width with arc length.
  bool begins = false;         ///< The growth or the direction may jump here: a place of its own on either side.
};

/// Pieces of a line that follow each other, each with a width, as places so dense that a stroke between two of them is
/// straight but for a hundredth of its width.
struct StrokeMiddle {
  std::vector<MiddlePlace> places;
  bool closed = false;  ///< The last place is the first one's.
};

/// The stretches of a line whose pieces have widths and meet. Not complete when cancelled.
std::vector<StrokeMiddle> strokeMiddles(const ExportCurve&, CancelCheck check = {});

}  // namespace batten
