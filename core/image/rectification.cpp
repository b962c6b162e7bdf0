// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectification.h"

#include <algorithm>
#include <cmath>

#include "core/base/angle.h"

namespace batten {
namespace {

// [mm] upright
constexpr std::array kPaperSizes = {
    PaperSize{PaperFormat::A6, "a6", "A6", 105, 148},
    PaperSize{PaperFormat::A5, "a5", "A5", 148, 210},
    PaperSize{PaperFormat::A4, "a4", "A4", 210, 297},
    PaperSize{PaperFormat::A3, "a3", "A3", 297, 420},
    PaperSize{PaperFormat::A2, "a2", "A2", 420, 594},
    PaperSize{PaperFormat::A1, "a1", "A1", 594, 841},
    PaperSize{PaperFormat::A0, "a0", "A0", 841, 1189},
    PaperSize{PaperFormat::Letter, "letter", "Letter", 215.9, 279.4},
    PaperSize{PaperFormat::Legal, "legal", "Legal", 215.9, 355.6},
    PaperSize{PaperFormat::Tabloid, "tabloid", "Tabloid", 279.4, 431.8},
};
constexpr double kShortestSidePx = 32.0;     // of a sheet: no corners are nearer to each other
constexpr double kSharpestCornerDeg = 15.0;  // a sheet seen so flat shows no line across any more

tl::unexpected<Error> bad(const char* message) { return fail(ErrorCode::BadParameter, message); }

}  // namespace

std::span<const PaperSize> paperSizes() { return kPaperSizes; }

const PaperSize* sizeOf(PaperFormat format) {
  const auto found = std::ranges::find(kPaperSizes, format, &PaperSize::format);
  return found == kPaperSizes.end() ? nullptr : &*found;
}

std::optional<Error> validate(const RectifyParams& params) {
  if (params.use != RectifyUse::Corners) return std::nullopt;
  const SheetCorners& corners = params.cornersPx;
  bool isFlat = false;
  int clockwise = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 in = corners[(i + 1) % 4] - corners[i], out = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!corners[i].allFinite() || !(in.norm() >= kShortestSidePx))
      return bad("The sides of the sheet (paper.rectify) must be at least 32 px long.").value();
    clockwise += cross(in, out) > 0.0 ? 1 : 0;  // y down
    isFlat = isFlat || std::abs(cross(in, out)) < std::sin(kSharpestCornerDeg * kRadPerDeg) * in.norm() * out.norm();
  }
  if (clockwise == 0)
    return bad("The corners of the sheet (paper.rectify) must go round it clockwise, from its upper left corner on; "
               "these go the other way.")
        .value();
  if (clockwise != 4)
    return bad("The corners of the sheet (paper.rectify) must be those of a convex quadrilateral, clockwise from its "
               "upper left corner on; its sides must not cross.")
        .value();
  if (isFlat)
    return bad("The sheet (paper.rectify) is seen too flat: each of its corners must have 15 to 165 degrees on the "
               "picture.")
        .value();
  return std::nullopt;
}

}  // namespace batten
