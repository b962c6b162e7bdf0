// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/contour/edge_choices.h"
#include "core/image/run_pieces.h"

namespace batten {

/// Which choice each piece of ink follows; pieces are the regions of one kind (ink_split.h).
class ChosenInk {
 public:
  ChosenInk(const RunPieces& pieces, std::span<const EdgeChoice> choices);
  /// @param piece as in RunPieces::piece. Index of its choice; -1 = none.
  int choiceOf(int piece) const;
  /// Choice of the ink on or next to a place [px]; -1 = none, or no ink there.
  int choiceAt(const Vec2& px) const;
  /// The choices that no ink is near to.
  const std::vector<EdgeChoice>& withoutInk() const { return withoutInk_; }

 private:
  const RunPieces& pieces_;
  std::vector<std::pair<int, int>> chosen_;  ///< Piece and choice.
  std::vector<EdgeChoice> withoutInk_;
};

}  // namespace batten
