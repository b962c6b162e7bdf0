// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <vector>

#include "core/base/vec2.h"

namespace batten {

/// Of a piece or a bundle: on which of the lines that merging by one distance gives it lies, by the share of its
/// samples (merge_shares.h). The shares sum up to 1 at most.
using MergeShares = std::map<int, double>;

/// One or more strokes that are taken for one curve, by their mean, in steps of about one stroke width. All lengths of
/// the rooms of intent are in stroke widths.
struct Strip {
  std::vector<Vec2> at;
  std::vector<Vec2> tangent;  ///< Unit direction of travel.
  bool closed = false;
  std::vector<int> members;                     ///< Pieces (stroke_pieces.h).
  std::array<bool, 2> isFree = {false, false};  ///< No other ink lies around the start, the end.
  double spread = 0.0;                          ///< Root mean square distance of its strokes from the mean.
  double inkPerLength = 1.0;                    ///< [-] How often it was drawn over.
  MergeShares merged;
  int count() const { return static_cast<int>(at.size()); }
  double length() const { return static_cast<double>(at.size()) - (closed ? 0.0 : 1.0); }
};

/// Sets the tangents from the positions: chords over two steps to either side.
void setTangents(Strip&);

}  // namespace batten
