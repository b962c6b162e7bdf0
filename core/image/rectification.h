// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/base/result.h"
#include "core/base/vec2.h"

namespace batten {

/// Formats of paper, by which the aspect ratio and the scale of a rectified sheet are known.
enum class PaperFormat { Unknown, A6, A5, A4, A3, A2, A1, A0, Letter, Legal, Tabloid };

/// [mm]
struct PaperSize {
  PaperFormat format = PaperFormat::Unknown;
  std::string_view word, name;  ///< As files and the command line write it, and as people do.
  double shortMm = 0.0, longMm = 0.0;
};
/// All formats but Unknown.
std::span<const PaperSize> paperSizes();
/// Null for Unknown.
const PaperSize* sizeOf(PaperFormat);

/// Corners of a sheet on the picture, px: clockwise from the corner that becomes the upper left one.
using SheetCorners = std::array<Vec2, 4>;

enum class RectifyUse {
  Off,        ///< The page is the picture as it was taken.
  Automatic,  ///< The corners of the sheet are found on the picture; without a sheet the picture stays.
  Corners,    ///< Its corners are stated.
};

/// How a sheet that was photographed at an angle is made a rectangle again.
struct RectifyParams {
  RectifyUse use = RectifyUse::Off;
  SheetCorners cornersPx{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};  ///< Counts for Corners alone.
  PaperFormat format = PaperFormat::Unknown;  ///< Unknown: the aspect ratio is estimated from the perspective.
  bool operator==(const RectifyParams&) const = default;
};
/// The same with these corners stated.
inline RectifyParams withCorners(const RectifyParams& params, const SheetCorners& cornersPx) {
  return {RectifyUse::Corners, cornersPx, params.format};
}
/// Refuses corners that are no convex quadrilateral in clockwise order, or too small a one.
std::optional<Error> validate(const RectifyParams&);

/// How a page was rectified: with its corners it says which place of the picture became which of the page.
struct Rectification {
  SheetCorners cornersPx;
  int widthPx = 0, heightPx = 0;  ///< Of the page: the sheet from corner to corner.
  double aspect = 1.0;            ///< Width over height.
  double aspectError = 0.0;       ///< Standard error of `aspect` as a share of it; 0 for a known format.
  std::optional<double> dpi;      ///< Of the page, from the format.
  double scale = 1.0;             ///< Pixels of the page for one of the picture, on average, along a line.
  double outsideShare = 0.0;      ///< 0..1 of the picture that is not on the page.
  double bendPx = 0.0;            ///< [px of the picture] How far the edges found are from straight lines.
};

}  // namespace batten
