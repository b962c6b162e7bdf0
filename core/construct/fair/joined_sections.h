// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/fair/sharp_features.h"
#include "core/construct/pieces.h"

namespace batten {

/// What lies between two arc lengths of a part of a curve, and where that begins in the whole.
struct NotedStretch {
  double from = 0.0, to = 0.0;  ///< [px] In the part.
  double offset = 0.0;          ///< [px] Of `from` in the whole.
};
/// Adds the notes of a stretch of a part to those of the whole.
void addNotes(ConstructReport& whole, const ConstructReport& part, const NotedStretch&);

/// A piece cut into sections: which points turn sharply, which are smooth, and the fit of each smooth section.
struct FittedSections {
  std::span<const PointRange> sharp, smooth;
  std::span<const ConstructedPiece> fits;  ///< One per smooth section.
};
/// Fits and corner fills through the sharp features as one curve, with the reports together. All in px.
Result<ConstructedPiece> joinSections(const ConstructPiece&, const FittedSections&, const RunContext&);

}  // namespace batten
