// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/contour/edge_choices.h"
#include "core/image/bits/run_pieces.h"

namespace batten {

/// Which of the user's choices applies to each piece of ink; pieces are the regions of one kind (ink_split.h).
class ChosenInk {
 public:
  ChosenInk(const RunPieces& pieces, std::span<const EdgeChoice> choices);
  /// @param piece as in RunPieces::piece. Index of its choice, if it has one.
  std::optional<int> choiceOf(int piece) const;
  /// Index of the choice of the ink on or next to a place [px]; absent where there is no choice or no ink.
  std::optional<int> choiceAt(const Vec2& px) const;
  /// The choices without ink near them.
  const std::vector<EdgeChoice>& withoutInk() const { return withoutInk_; }

 private:
  struct Chosen {
    int piece = 0, choice = 0;
  };
  const RunPieces& pieces_;
  std::vector<Chosen> chosen_;
  std::vector<EdgeChoice> withoutInk_;
};

}  // namespace batten
