// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// The colour of the paper: what a channel has more or less than the grey, as a quadratic over the page (a lamp's light
/// changes slowly), and the grey of the paper by place. Shading darkens all channels alike and leaves the ratios.
struct PaperColour {
  /// Per channel (red, green, blue): ratio to the grey = sum of c[i] * {1, u, v, u u, u v, v v}, u and v = 0..1 across
  /// and down the page.
  std::array<std::array<double, 6>, 3> ratio{};
  int cellPx = 32, columns = 0, rows = 0;  ///< [px] side of a cell; cells across and down.
  std::vector<float> bright;  ///< [grey 0..255] columns * rows: the brighter part of every cell and its neighbours.
  std::vector<float> level;   ///< [grey 0..255] the same of every cell by itself, where it holds paper.
  double paperLevel = 255.0;  ///< [grey] Median of the bright cells of the page.

  /// Ratios of the three channels at the pixel centres of row y. @param out three rows of `width` values, in memory
  /// that the caller keeps from row to row.
  void ratiosOfRow(int y, int width, int height, std::array<std::vector<float>, 3>& out) const;
  /// Grey of the paper around a pixel. @pre inside the page.
  float paperAt(int x, int y) const { return bright[y / cellPx * columns + x / cellPx]; }
  /// The same without steps: bilinear between the middles of the cells.
  float levelAt(int x, int y) const;
};

/// Measures the paper on the brighter part of every cell of the page; cells of other colours (filled areas, a table
/// beside the sheet) are outvoted as long as most of the page is paper.
PaperColour measurePaperColour(const GreyImage&, const ColourImage&, const RunContext&);

}  // namespace batten
