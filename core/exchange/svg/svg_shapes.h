// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/imported_line.h"

namespace batten {

/// What a drawing program's SVG holds of lines.
struct SvgShapes {
  std::vector<ImportedLine> lines;  ///< In mm, y up, from the lower left corner of the page.
  int left = 0;                     ///< Texts, pictures, copies (use) and what cannot be understood.
  double mmPerUnit = 1.0;           ///< Of the page's units; the smaller one where x and y differ.
  bool hasSize = true;              ///< False: no physical size is stated, a unit is taken for 1/96 inch.
};

/// Reads the path, line, polyline, polygon, rect, circle and ellipse elements of any SVG, with all transforms and the
/// view box; what is only defined, cut out or not displayed is passed over. Every part of a path is a line of its own;
/// cubics and quadratics stay exact (quadratics as cubics), arcs become rational quadratics. Curves that go on in the
/// same direction, to a degree, are one curve, others meet at a corner. Elements may lie 256 deep.
/// @return BadParameter if it is damaged. Cancelled.
Result<SvgShapes> readSvgShapes(std::string_view text, const RunContext& context = {});

}  // namespace batten
