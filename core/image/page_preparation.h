// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/image/colour/inks.h"
#include "core/image/rectified_scan.h"
#include "core/image/ruling/dot_grid.h"
#include "core/image/ruling/rulings.h"
#include "core/image/scan.h"
#include "core/image/sheet/paper_sheet.h"

namespace batten {

/// How the colours of a scan become its grey.
enum class ColourUse {
  Darkest,  ///< Coloured ink that gains by it takes the darkest of its channels, everything else its grey.
  Grey,     ///< The luma of Rec. 601 everywhere.
};

/// What becomes of printed lines and dots of the paper.
enum class RulingUse {
  LeaveOut,  ///< Ruled lines, grids and dots of dotted paper are found and taken out of the page.
  Keep,      ///< They are ink as any other.
};

/// What becomes of the surroundings of the sheet in a photograph.
enum class SheetUse {
  CutOff,  ///< The sheet is found, and what lies beside it is painted over.
  Off,     ///< The whole picture is the page.
};

/// What becomes of areas of tone that lines are drawn on and around (shading.h).
enum class ShadingUse {
  LeaveOut,  ///< They are paper to the lines.
  Keep,      ///< They are ink as any other.
};

/// What the lines are to the paper.
enum class LineTone {
  Auto,      ///< Found by the page (bright_lines.h).
  Darker,    ///< As pencil and ink on paper.
  Brighter,  ///< As chalk on a blackboard, or a blueprint: the page is inverted.
};

/// What is done to a scan before its thresholds.
struct PreparationParams {
  LineTone lines = LineTone::Auto;
  ColourUse colour = ColourUse::Darkest;
  RulingUse rulings = RulingUse::LeaveOut;
  SheetUse sheet = SheetUse::CutOff;
  ShadingUse shading = ShadingUse::LeaveOut;
  RectifyParams rectify;  ///< Has been applied to the scan before (rectified_scan.h).
  InkChoice inks;
  bool operator==(const PreparationParams&) const = default;
};

/// The page as it is traced.
struct PreparedPage {
  std::optional<GreyImage> grey;      ///< Of the scan's size; absent: the scan's own grey, untouched.
  double colouredShare = 0.0;         ///< 0..1 of the page, taken by its darkest channel.
  std::vector<RulingFamily> rulings;  ///< What was taken out of it.
  std::vector<PrintedDot> dots;       ///< Of dotted paper, likewise.
  std::optional<PaperSheet> sheet;    ///< What lies beside it was painted over.
  int bindingHoles = 0;               ///< Painted over.
  std::optional<SheetView> view;      ///< How the sheet lies on a picture that is not rectified, where it is angled.
  std::vector<FoundInk> inks;         ///< Of a colour scan: all of them, also those that were dropped.
  double droppedShare = 0.0;          ///< 0..1 of the page: inks painted over.
  double shadedShare = 0.0;           ///< 0..1 of the page, clearly shaded: its ground was made paper.
  bool isInverted = false;            ///< Its lines were brighter than the paper; inks are not told apart on it.
  std::vector<std::string> notes;     ///< What the user should know, one line each.
  bool isUntouched() const { return !grey; }
};

/// What is wrong with its corners or its inks, if anything.
std::optional<Error> validate(const PreparationParams&);

/// Makes the grey page that all later stages read. A grey scan of which nothing is left out stays bit by bit as it is.
/// @return Cancelled or OutOfMemory.
Result<PreparedPage> preparePage(const Scan&, const PreparationParams&, const RunContext&);

}  // namespace batten
