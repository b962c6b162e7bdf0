// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/contour_set.h"

namespace batten {

/// The lines around each line of a drawing, by their directions.
class LineCompany {
 public:
  /// @param isOut for each line of the set: it is nobody's company. @param widthPx [px] of the lines.
  LineCompany(const ContourSet& set, const std::vector<bool>& isOut, double widthPx);

  /// Whether a line runs as those around it do, within 8 widths, and more than chance explains: hatching, strands of
  /// hair, the dashes of a line. @param line its index in the set.
  bool isOneOf(int line) const;

 private:
  /// A part of a line that has one direction.
  struct Stretch {
    Vec2 at, along;  ///< [px] its middle; from end to end
    int line;
  };
  /// Sums over pairs of stretches, by their lengths. [px^2]
  struct Likeness {
    double alike = 0.0, all = 0.0;
  };
  std::pair<int, int> cellOf(const Vec2& at) const;
  Likeness likenessOf(const Stretch&) const;

  double widthPx_;
  std::map<std::pair<int, int>, std::vector<Stretch>> cells_;
  std::vector<std::vector<Stretch>> ofLine_;
};

}  // namespace batten
