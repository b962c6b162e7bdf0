// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <tl/expected.hpp>

#include "core/base/run_context.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"

namespace batten {

/// Whether this build can read PDF. Without Poppler all of this room fails with NotInstalled.
bool hasPdf();

enum class PdfProblem { NotInstalled, Damaged, Locked, NoSuchPage, Cancelled };

struct PdfPage {
  int pages = 1;              ///< Of the file.
  double widthPoints = 0.0;   ///< [1/72 inch] as it is shown, rotated.
  double heightPoints = 0.0;  ///< [1/72 inch]
};

/// Why a page cannot be had.
struct PdfRefusal {
  PdfProblem problem = PdfProblem::Damaged;
  int pages = 1;  ///< Of the file, where it could be opened.
};

/// What a file says of one of its pages, counted from 1.
tl::expected<PdfPage, PdfRefusal> lookAtPdfPage(std::span<const std::byte> file, int number);

struct PdfPicture {
  GreyImage grey;  ///< The luma of Rec. 601.
  ColourImage colour;
};

/// The page on white paper, images and lines alike. @pre lookAtPdfPage found it.
struct PdfSize {
  int widthPx = 0, heightPx = 0;
  double dpi = 300.0;
};
tl::expected<PdfPicture, PdfProblem> drawPdfPage(std::span<const std::byte> file, int number, const PdfSize&,
                                                 const RunContext&);

}  // namespace batten
