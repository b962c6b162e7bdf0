// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/image/bits/bit_image.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

inline constexpr double kLongestLettering = 64.0;  ///< [pens] of a line of lettering: a dozen letters

/// [pens] Of letters with their tails, of a large one alone, of the lowest word and the lowest letter. Of a pen a line
/// drawn twice is lower than a word: two strokes and no more between them than withoutClosedPaper() opens anyway.
struct LetterSize {
  double highest, alone, lowestWord, lowest;
};
inline constexpr LetterSize kPencilLetters{24.0, 16.0, 0.0, 0.0}, kPenLetters{12.0, 12.0, 3.3, 2.5};

/// Whether a piece of ink has the size of a letter or of a line of letters.
bool mayBeLettering(const PieceBox& box, double penPx, const LetterSize& size);

/// The pieces that may be a line of lettering, or part of one; absent: there are none.
std::optional<BitImage> letteringOf(const RunPieces& pieces, const BitImage& ink, double penPx, const LetterSize& size);

}  // namespace batten
