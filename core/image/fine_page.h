// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"
#include "core/image/bits/neighbourhood_filter.h"
#include "core/image/grey_image.h"
#include "core/image/threshold/region_thresholds.h"

namespace batten {

/// A page and its ink, enlarged. The paper between strokes of two or three pixels, as in small lettering, is so narrow
/// that the smoothing before the thresholds fills it and that a skeleton has no pixel to go round it: here it stays
/// open.
struct FinePage {
  std::shared_ptr<const GreyImage> grey;  ///< Never null; parts of the ink share it.
  BitImage ink;
};
inline constexpr int kFineFactor = 2;  ///< Pixels of a fine page along a pixel of the page.

/// How the ink of a page was found, which holds for its fine page, too.
struct InkSettings {
  PaperParams paper;
  ThresholdParams threshold;  ///< Areas in px^2 of the page.
  FilterParams filter;
};

/// The page with `kFineFactor` times as many pixels along a side, by cubic interpolation.
GreyImage enlarged(const GreyImage&, const RunContext&);
/// Ink, every pixel as kFineFactor x kFineFactor ones.
BitImage enlarged(const BitImage&, const RunContext&);

/// The page with as much of its ink as lies on `ink`, a part of that of the page.
FinePage onInk(const FinePage&, const BitImage& ink, const RunContext&);

/// The fine page, where the strokes of `ink` are so thin that one is needed; absent where they are not, or where it
/// would be too large. It has no ink beside that of the page; what only the smoother page shows of it, as faint lines,
/// is in it as it was.
/// @param grey without folds.
Result<std::optional<FinePage>> finePage(const GreyImage& grey, const BitImage& ink, const InkSettings&,
                                         const RunContext&);

}  // namespace batten
