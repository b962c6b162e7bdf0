// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectified_scan.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/base/angle.h"
#include "core/base/conventions.h"
#include "core/base/number_text.h"
#include "core/image/rectify/resample.h"
#include "core/image/rectify/sheet_aspect.h"
#include "core/image/rectify/sheet_corners.h"
#include "core/image/rectify/sheet_map.h"

namespace batten {
namespace {

constexpr double kMostCornerOutside = 0.1;  // of the longer side of the picture, that a corner may lie outside it
constexpr double kMostPagePixels = 2.0;     // of the page for one of the picture: the far part is made no larger
constexpr double kLeastViewAngleDeg = 1.0;  // a drawing is as true by hand
constexpr double kReachCells = 4.0;         // how exactly the sheet's cells tell its corners
constexpr double kShortestPagePx = 32.0;    // of a side: technical limit of a rectified page

double areaOfSheet(const SheetCorners& c) { return 0.5 * cross(c[2] - c[0], c[3] - c[1]); }

/// The share of the sheet's area that lies on the picture.
double areaInside(const SheetCorners& corners, double width, double height) {
  // Cut by one side of the picture after the other.
  std::vector<Vec2> polygon(corners.begin(), corners.end());
  const auto cutBy = [&polygon](const auto& depth) {
    std::vector<Vec2> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = depth(a), db = depth(b);
      if (da >= 0.0) left.push_back(a);
      if ((da >= 0.0) != (db >= 0.0)) left.emplace_back(a + da / (da - db) * (b - a));
    }
    polygon = std::move(left);
  };
  cutBy([](const Vec2& p) { return p.x(); });
  cutBy([](const Vec2& p) { return p.y(); });
  cutBy([width](const Vec2& p) { return width - p.x(); });
  cutBy([height](const Vec2& p) { return height - p.y(); });
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) area += 0.5 * cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return area;
}

/// [px of the page] Width, by which no part of the page has fewer pixels than the picture, within kMostPagePixels.
double pageWidth(const SheetCorners& corners, double aspect) {
  const SheetMap map(corners, aspect, 1.0);
  double finest = 0.0;
  for (const Vec2& corner : {Vec2(0.0, 0.0), Vec2(aspect, 0.0), Vec2(aspect, 1.0), Vec2(0.0, 1.0)}) {
    const Eigen::Matrix2d slope = map.slopeAt(corner);
    // The largest singular value.
    const double sum = slope.squaredNorm(), det = slope.determinant();
    finest = std::max(finest, std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * det * det)))));
  }
  return aspect * std::min(finest, std::sqrt(kMostPagePixels * areaOfSheet(corners) / aspect));
}

double knownAspect(const PaperSize& paper, double seen) {
  const double upright = paper.shortMm / paper.longMm;
  return seen < 1.0 ? upright : 1.0 / upright;
}

std::string outsideText(const GreyImage& grey) {
  return "A corner of the sheet (paper.rectify) lies too far outside the picture of " + std::to_string(grey.width) +
         " x " + std::to_string(grey.height) + " px.";
}

Result<SheetCorners> cornersFor(const Scan& scan, const RectifyParams& params, double& bendPx,
                                const RunContext& context) {
  if (params.use == RectifyUse::Corners) return params.cornersPx;
  const auto sheet = findPaperSheet(scan.grey, scan.colour, context);
  if (context.isCancelled()) return cancelled();
  if (!sheet || sheet->cornersPx.size() != 4)
    return fail(ErrorCode::UnreadableScan,
                "No sheet with four corners is seen on the picture; state its corners instead: "
                "paper.rectify=X,Y,X,Y,X,Y,X,Y.");
  SheetCorners rough;
  std::copy_n(sheet->cornersPx.begin(), rough.size(), rough.begin());
  const auto found = sheetCorners(scan.grey, scan.colour, rough, kReachCells * sheet->cellPx, context);
  if (!found) return fail(found.error());
  bendPx = found->bendPx;
  return found->cornersPx;
}

/// The page, or why it stays as it is.
struct RectifiedPage {
  std::optional<Scan> page;
  std::string note;
};
Result<RectifiedPage> rectifiedPage(const Scan& scan, const RectifyParams& params, const RunContext& context) {
  if (params.use == RectifyUse::Off || isBlank(scan)) return RectifiedPage{};
  try {
    double bendPx = 0.0;
    const auto corners = cornersFor(scan, params, bendPx, context);
    if (!corners && corners.error().code == ErrorCode::UnreadableScan)
      return RectifiedPage{{}, "The page was not rectified. " + corners.error().message};
    if (!corners) return fail(corners.error());
    auto made = rectificationOf(scan, *corners, params.format);
    if (!made) return fail(made.error());
    made->bendPx = bendPx;
    const SheetMap map(*made);
    Scan page;
    page.grey = resampled(scan.grey, map, made->widthPx, made->heightPx, context);
    page.colour = resampled(scan.colour, map, made->widthPx, made->heightPx, context);
    if (context.isCancelled()) return cancelled();
    page.info = scan.info;
    page.page = scan.page;
    page.pages = scan.pages;
    page.fileHash = scan.fileHash;
    page.path = scan.path;
    page.rectify = params;
    page.dpi = made->dpi;
    if (!page.dpi && scan.dpi) page.dpi = *scan.dpi * made->scale;
    page.rectification = std::move(*made);
    return RectifiedPage{std::move(page), {}};
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to rectify the page; scan at a lower resolution or crop.");
  }
}

}  // namespace

bool SheetView::isAngled() const { return std::max(convergenceDeg, skewDeg) >= kLeastViewAngleDeg; }

std::string SheetView::text() const {
  return "a right angle is seen as " + roundedText(90.0 - skewDeg, 1) + " or " + roundedText(90.0 + skewDeg, 1) +
         " degrees, and parallel sides converge by " + roundedText(convergenceDeg, 1) + " degrees";
}

Result<Rectification> rectificationOf(const Scan& scan, const SheetCorners& corners, PaperFormat format) {
  if (auto wrong = validate(RectifyParams{RectifyUse::Corners, corners, format})) return fail(std::move(*wrong));
  const double width = scan.grey.width, height = scan.grey.height;
  const double most = kMostCornerOutside * std::max(width, height);
  for (const Vec2& corner : corners) {
    if (corner.x() < -most || corner.y() < -most || corner.x() > width + most || corner.y() > height + most)
      return fail(ErrorCode::BadParameter, outsideText(scan.grey));
  }
  Rectification made;
  made.cornersPx = corners;
  const SheetAspect seen = sheetAspect(corners, {scan.grey.width, scan.grey.height, scan.info.focal35Mm});
  const PaperSize* paper = sizeOf(format);
  made.aspect = paper ? knownAspect(*paper, seen.aspect) : seen.aspect;
  made.aspectError = paper ? 0.0 : seen.error;
  const double across = pageWidth(corners, made.aspect);
  if (std::min(across, across / made.aspect) < kShortestPagePx)
    return fail(ErrorCode::BadParameter, "The sheet (paper.rectify) is too small on the picture.");
  made.widthPx = static_cast<int>(std::lround(across));
  made.heightPx = static_cast<int>(std::lround(across / made.aspect));
  made.scale = std::sqrt(across * across / made.aspect / areaOfSheet(corners));
  if (paper) made.dpi = std::max(made.widthPx, made.heightPx) * kMillimetresPerInch / paper->longMm;
  made.outsideShare = std::max(0.0, 1.0 - areaInside(corners, width, height) / (width * height));
  return made;
}

std::optional<SheetView> sheetView(const Scan& scan, const PaperSheet& sheet, const RunContext& context) {
  if (sheet.cornersPx.size() != 4) return std::nullopt;
  SheetCorners rough;
  std::copy_n(sheet.cornersPx.begin(), rough.size(), rough.begin());
  const auto found = sheetCorners(scan.grey, scan.colour, rough, kReachCells * sheet.cellPx, context);
  if (!found) return std::nullopt;
  auto made = rectificationOf(scan, found->cornersPx, PaperFormat::Unknown);
  if (!made) return std::nullopt;
  SheetView view{std::move(*made)};
  view.rectification.bendPx = found->bendPx;
  const auto& c = found->cornersPx;
  const auto angle = [](const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)) * kDegPerRad; };
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec2 side = c[(i + 1) % 4] - c[i], next = c[(i + 2) % 4] - c[(i + 1) % 4];
    const Vec2 opposite = c[(i + 2) % 4] - c[(i + 3) % 4];
    view.skewDeg = std::max(view.skewDeg, std::abs(angle(side, next) - 90.0));
    view.convergenceDeg = std::max(view.convergenceDeg, std::abs(angle(side, opposite)));
  }
  return view;
}

Result<Scan> rectified(Scan&& scan, const RectifyParams& params, const RunContext& context) {
  auto made = rectifiedPage(scan, params, context);
  if (!made) return fail(made.error());
  if (made->page) return std::move(*made->page);
  Scan same = std::move(scan);
  same.rectify = params;
  same.rectifyNote = std::move(made->note);
  return same;
}

Result<Scan> rectified(const Scan& scan, const RectifyParams& params, const RunContext& context) {
  auto made = rectifiedPage(scan, params, context);
  if (!made) return fail(made.error());
  if (made->page) return std::move(*made->page);
  Scan same = scan;
  same.rectify = params;
  same.rectifyNote = std::move(made->note);
  return same;
}

bool isRectifiedAs(const Scan& scan, const RectifyParams& params) {
  return params.use == RectifyUse::Off ? scan.rectify.use == RectifyUse::Off : scan.rectify == params;
}

}  // namespace batten
