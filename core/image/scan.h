// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/base/content_hash.h"
#include "core/base/page_frame.h"
#include "core/base/result.h"
#include "core/image/colour_image.h"
#include "core/image/grey_image.h"
#include "core/image/rectification.h"

namespace batten {

inline constexpr int kMostPages = 100000;                                // limit of input
inline constexpr double kCoarsestPdfDpi = 20.0, kFinestPdfDpi = 4800.0;  // [dpi] limits of input

/// Which page of a file is read, and how finely a page is drawn that has no pixels of its own.
struct PageChoice {
  int number = 1;         ///< 1..kMostPages, of a TIFF or PDF; other files have one page.
  double pdfDpi = 300.0;  ///< [dpi] kCoarsestPdfDpi..kFinestPdfDpi. Of the pages of a PDF.
  bool operator==(const PageChoice&) const = default;
};
/// First invalid field, with its range, if any.
std::optional<Error> validate(const PageChoice&);

/// What is known of an image file from its header alone, before any large allocation.
struct ScanInfo {
  std::string format;               ///< "PNG", "JPEG", "TIFF", "BMP", "WebP", "PNM", "JPEG 2000", "PDF".
  int width = 0;                    ///< [px] as stored, before the EXIF rotation.
  int height = 0;                   ///< [px]
  int channels = 1;                 ///< As stored, alpha included.
  int bitsPerChannel = 8;           ///< 1, 2, 4, 8 or 16.
  int exifOrientation = 1;          ///< 1..8; 1 = upright.
  std::optional<double> dpi;        ///< Resolution stated by the file, if any and plausible.
  std::optional<double> focal35Mm;  ///< [mm] Focal length of the camera on film of 36 mm x 24 mm, if stated.
};

/// A scan as the program works on it: upright, grey, alpha laid over white.
struct Scan {
  GreyImage grey;
  ColourImage colour;  ///< Of the same size; empty where every pixel is grey.
  ScanInfo info;
  std::optional<double> dpi;                   ///< From the file; absent means unknown.
  PageChoice page;                             ///< What of the file it is.
  int pages = 1;                               ///< Of the file, thumbnails not counted.
  ContentHash fileHash;                        ///< SHA-256 of the file's bytes, as sha256sum prints it.
  std::string path;                            ///< As given by the user; for messages only.
  RectifyParams rectify;                       ///< How it was to be rectified; see rectified_scan.h.
  std::optional<Rectification> rectification;  ///< How it was.
  std::string rectifyNote;                     ///< Why it was not.
};

/// A page of white paper, for drawing without a scan. It takes no memory for its pixels. Its format is "blank", its
/// path empty; the hash stands for the size.
/// @pre width and height > 0.
Scan blankScan(int widthPx, int heightPx, double dpi);
/// Whether it is such a page.
bool isBlank(const Scan&);

/// The frame of a scan at a resolution; an absent one means the assumed resolution (conventions.h).
PageFrame pageFrame(const Scan& scan, std::optional<double> dpi);

}  // namespace batten
