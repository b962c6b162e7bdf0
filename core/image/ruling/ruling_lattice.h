// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/ruling/ruling_stretches.h"

namespace batten {

/// Equally spaced lines across a plane: line k runs along y = at(k, x). Slightly rotated, bent and in perspective.
struct RulingLattice {
  double slope = 0.0;                   ///< [-] dy/dx that most of its lines share.
  double fromX = 0.0, halfWidth = 1.0;  ///< [grid] It runs from there on, twice as far; x is divided by it.
  double middle = 0.0, reach = 1.0;     ///< k is centred and divided by these.
  static constexpr int kTerms = 18;
  std::array<double, kTerms> coefficients{};  ///< Of a polynomial of degree five, cubic in k.
  int first = 0, last = 0;                    ///< Lines seen, the outermost ones.
  double spacing = 0.0;                       ///< [grid] mean.
  double seen = 0.0;         ///< Share of the lines from first to last that are seen along most of the page.
  double coverage = 0.0;     ///< Share of the stretches of these lines that are seen.
  double selective = 0.0;    ///< Share of the stretches over the lattice that lie on its lines.
  double misfit = 0.0;       ///< [grid] median distance of the stretches from the lattice.
  std::vector<bool> isSeen;  ///< From first to last: line by line.

  double toX() const { return fromX + 2.0 * halfWidth; }
  /// [grid] y of line k at x.
  double at(double k, double x) const;
};

/// The lattice of thin dark lines across the plane (they run along x, sloped by at most 1 in 5), if there is one that
/// has at least five lines, more than half of its lines seen, and fills half of the plane both ways.
std::optional<RulingLattice> findRulingLattice(const RulingStretches& found, const RunContext& context);

}  // namespace batten
