// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/lettering.h"

#include <algorithm>
#include <vector>

namespace batten {

bool mayBeLettering(const PieceBox& box, double penPx, const LetterSize& size) {
  constexpr double kLongerThanHigh = 1.5;  // of two letters or more
  const double longer = std::max(box.width(), box.height()) / penPx;
  const double lower = std::min(box.width(), box.height()) / penPx;
  const bool isLine = longer <= kLongestLettering && lower >= size.lowestWord && lower <= size.highest &&
                      longer >= kLongerThanHigh * lower;
  return isLine || (longer <= size.alone && lower >= size.lowest);
}

std::optional<BitImage> letteringOf(const RunPieces& pieces, const BitImage& ink, double penPx,
                                    const LetterSize& size) {
  const std::vector<PieceBox> boxes = boxesOfPieces(pieces);
  std::vector<bool> isLettering(boxes.size(), false);
  std::optional<BitImage> lettering;
  for (int i = 0; i < std::ssize(pieces.runs); ++i) {
    const int first = pieces.piece[i];
    if (first == i) isLettering[i] = mayBeLettering(boxes[i], penPx, size);
    if (!isLettering[first]) continue;
    if (!lettering) lettering.emplace(ink.width, ink.height);
    setBits(*lettering, pieces.runs[i]);
  }
  return lettering;
}

}  // namespace batten
