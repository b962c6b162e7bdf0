// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/image/ruling/dot_marks.h"

namespace batten {

/// Marks at the places of one lattice whose two steps change slowly over the page.
struct DotLattice {
  std::vector<int> dots;  ///< Of the marks.
  double spacing = 0.0;   ///< [px] The shorter step, the median over the dots.
  double misfit = 0.0;    ///< [px] How far a dot lies from the middle of its neighbours, the median.
  int taken = 0;          ///< Places beside a dot that hold another one.
  int bare = 0;           ///< Likewise that hold none, though nothing hides it.
};

/// The lattice of the most marks: each lies where the steps of a neighbour lead to, and is about as large and as dark.
DotLattice largestDotLattice(const DotMarks&);

}  // namespace batten
