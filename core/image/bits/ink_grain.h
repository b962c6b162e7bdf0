// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/base/run_context.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// Of ink in [specks and holes per stroke width]: a pen leaves up to .06, a dry brush, pencil or charcoal .12 to .35.
constexpr double kTornInk = 0.1;
/// A part of the ink with more is not taken as whole: half-way from a pen's to a pencil's. For the page as a whole a
/// mistake costs less.
constexpr double kWholeInk = 0.08;
/// [widths of torn ink, half that of its strokes] More smoothing rounds strokes off.
constexpr double kSmoothingPerWidth = 0.45;

/// What grain is told by, of any part of the ink; of parts it adds up.
struct InkCounts {
  std::int64_t area = 0, border = 0;  ///< [px]
  std::int64_t small = 0;             ///< Specks and holes.
  /// [px] @pre a border
  double widthPx() const { return 2.0 * static_cast<double>(area) / static_cast<double>(border); }
  /// Specks and holes per width along the strokes; 0 without a border.
  double grain() const {
    return border > 0 ? static_cast<double>(small) * widthPx() / (0.5 * static_cast<double>(border)) : 0.0;
  }
  void add(const InkCounts& other) {
    area += other.area;
    border += other.border;
    small += other.small;
  }
};

/// How far ink is torn: the grain of a pencil or of charcoal on rough paper.
struct InkGrain {
  double widthPx =
      0.0;  ///< [px] Twice the area by the border: of whole ink the width of its strokes, of torn ink less.
  double perWidth = 0.0;  ///< [-] Specks and holes smaller than a square of that width, per width along the strokes.
};

/// No ink has a width of 0 and no grain.
InkGrain measureGrain(const BitImage& ink, const RunContext& context);

}  // namespace batten
