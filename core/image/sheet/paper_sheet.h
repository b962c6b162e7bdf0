// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/bits/bit_image.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

struct SheetCells;

/// The sheet of paper in a photograph or a scan that shows more than the sheet.
struct PaperSheet {
  int cellPx = 1;               ///< [px] What one pixel of `inside` covers a side.
  BitImage inside;              ///< The sheet without a narrow rim: its edge and the shadow along it are cut off, too.
  double outsideShare = 0.0;    ///< 0..1 of the picture.
  std::vector<Vec2> outlinePx;  ///< The border of `inside` as a polygon, image frame.
  std::vector<Vec2>
      cornersPx;  ///< The four corners of the whole sheet, from the top left clockwise; empty if it has none.
};

/// Finds the sheet: the largest even, bright area, if what lies beside it is of another brightness, colour or texture,
/// reaches the border of the picture at a corner of it, begins at an edge (sheet_step.h), and leaves the sheet about
/// convex. Absent where the paper fills the picture, and where that is doubtful: a drawing with a dark ground is no
/// table, nor is paper behind a fold or in a shadow, which is darker but has the sheet's colour and grain. Of an open
/// book both pages are the sheet if there is a drawing on each. White paper on a white table is found by its straight
/// edges (straight_sheet_edges.h), unless the drawing goes on beyond them; a sheet that lies free among other things,
/// however small, by its four sides (straight_sided_sheet.h).
std::optional<PaperSheet> findPaperSheet(const GreyImage&, const ColourImage&, const RunContext&);
std::optional<PaperSheet> findPaperSheet(const SheetCells&, const RunContext&);

/// Of a picture, in pixels.
struct PictureBox {
  int left = 0, top = 0, width = 0, height = 0;
};
/// The sheet that fills a part of a picture, without a narrow rim: the sheet's edge and the shadow along it. Its
/// outsideShare is 0, its corners are not known. @pre the part lies inside the picture
PaperSheet sheetWithinRim(int widthPx, int heightPx, const PictureBox& part);
/// The same of a scan whose sheet fills it.
PaperSheet sheetWithinRim(int widthPx, int heightPx);

}  // namespace batten
