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

/// A place of a strip. All lengths of the rooms of intent are in stroke widths.
struct StripSample {
  Vec2 at = Vec2::Zero();       ///< [stroke widths]
  Vec2 tangent = Vec2::Zero();  ///< Unit direction of travel.
  int strokes = 1;              ///< Pieces that it is the mean of; 0: laid over a gap.
};
/// One or more strokes that are taken for one curve, by their mean, in steps of about one stroke width.
struct Strip {
  std::vector<StripSample> samples;
  bool closed = false;
  std::vector<int> members;                     ///< Pieces (stroke_pieces.h).
  std::array<bool, 2> isFree = {false, false};  ///< No other ink lies around the start, the end.
  double spread = 0.0;                          ///< Root mean square distance of its strokes from the mean.
  double inkPerLength = 1.0;                    ///< [-] How often it was drawn over.
  MergeShares merged;
  int count() const { return static_cast<int>(samples.size()); }
  double length() const { return static_cast<double>(samples.size()) - (closed ? 0.0 : 1.0); }
};

/// Copies of the positions, for the functions of core/polyline. [stroke widths]
std::vector<Vec2> positionsOf(const std::vector<StripSample>&);
/// Sets the tangents from the positions: chords over two steps to either side.
void setTangents(Strip&);

}  // namespace batten
