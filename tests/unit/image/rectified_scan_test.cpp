// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectified_scan.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/image/page_preparation.h"
#include "core/image/rectify/resample.h"
#include "core/image/rectify/sheet_aspect.h"
#include "core/image/rectify/sheet_corners.h"
#include "core/image/rectify/sheet_map.h"
#include "tests/support/photo_page.h"

namespace batten {
namespace {

using test::PhotoCamera;
using test::PhotoPose;
using test::PhotoStyle;

constexpr int kTiltedWidth = 600, kTiltedHeight = 800;
constexpr double kGapMm = 30.0, kLineMm = 1.2;

/// Lines at every 30 mm across and down, none near the border of the sheet.
struct Grid {
  double widthMm, heightMm;
  double operator()(const Vec2& mm) const {
    if (mm.x() < 15.0 || mm.y() < 15.0 || mm.x() > widthMm - 15.0 || mm.y() > heightMm - 15.0) return 0.0;
    const auto isOn = [](double v) { return std::abs(std::remainder(v, kGapMm)) < 0.5 * kLineMm; };
    return isOn(mm.x()) || isOn(mm.y()) ? 1.0 : 0.0;
  }
};

Scan photoOf(const PhotoCamera& camera, const PhotoStyle& style = {}) {
  return renderPhoto(camera, Grid{camera.pose().widthMm, camera.pose().heightMm}, style);
}

RectifyParams automatic() {
  RectifyParams params;
  params.use = RectifyUse::Automatic;
  return params;
}

/// Where dark lines cross the middle between two others: [px] their centres by darkness.
double centreOfLine(const GreyImage& page, bool isAcross, double at, double expected) {
  constexpr int kReachPx = 6;
  double weight = 0.0, sum = 0.0;
  for (const int along : {static_cast<int>(at) - 1, static_cast<int>(at), static_cast<int>(at) + 1}) {
    for (int k = -kReachPx; k <= kReachPx; ++k) {
      const int over = static_cast<int>(expected) + k;
      const double level = isAcross ? page.level(along, over) : page.level(over, along);
      const double dark = std::max(0.0, 225.0 - level - 10.0);  // noise is none
      weight += dark;
      sum += dark * (over + 0.5);
    }
  }
  return weight > 0.0 ? sum / weight : -1e9;
}

/// [px] The farthest that a line of the grid lies from where it belongs on a page of this size.
double worstOfGrid(const GreyImage& page, const PhotoPose& pose) {
  double worst = 0.0;
  const double pxX = page.width / pose.widthMm, pxY = page.height / pose.heightMm;
  for (const bool isAcross : {true, false}) {
    const double across = isAcross ? pose.heightMm : pose.widthMm, along = isAcross ? pose.widthMm : pose.heightMm;
    for (double line = kGapMm; line < across - 16.0; line += kGapMm) {
      for (double at = kGapMm + 5.0; at < along - 16.0; at += 2.5) {
        if (std::abs(std::remainder(at, kGapMm)) < 4.0) continue;  // a crossing
        const double expected = line * (isAcross ? pxY : pxX);
        const double centre = centreOfLine(page, isAcross, at * (isAcross ? pxX : pxY), expected);
        worst = std::max(worst, std::abs(centre - expected));
      }
    }
  }
  return worst;
}

const std::vector<PhotoPose> kPoses = {
    {.tiltDeg = 25.0},
    {.panDeg = -20.0, .rollDeg = 4.0},
    {.tiltDeg = 20.0, .panDeg = 15.0, .rollDeg = -8.0},
    {.tiltDeg = -30.0, .panDeg = 20.0, .rollDeg = 12.0, .fill = 0.65},
    {.widthMm = 200.0, .heightMm = 200.0, .tiltDeg = 22.0, .panDeg = -18.0, .fill = 0.5},
    {.rollDeg = 7.0},
};

TEST(RectifiedScan, LinesAreStraightParallelAndAtRightAnglesAgain) {
  for (const PhotoPose& pose : kPoses) {
    const PhotoCamera camera(pose, kTiltedWidth, kTiltedHeight);
    RectifyParams params = withCorners({}, camera.corners());
    const auto page = rectified(photoOf(camera), params, {});
    ASSERT_TRUE(page) << page.error().message;
    EXPECT_LT(worstOfGrid(page->grey, pose), 0.3) << pose.tiltDeg << " " << pose.panDeg;
    const double aspect = static_cast<double>(page->grey.width) / page->grey.height;
    EXPECT_NEAR(aspect / (pose.widthMm / pose.heightMm), 1.0, 0.01) << pose.tiltDeg << " " << pose.panDeg;
  }
}

TEST(RectifiedScan, TheCornersAreFoundToAPartOfAPixel) {
  for (const bool isColour : {false, true}) {
    for (const PhotoPose& pose : kPoses) {
      if (isColour && pose.rollDeg == 0.0) continue;  // three of them
      const PhotoCamera camera(pose, kTiltedWidth, kTiltedHeight);
      PhotoStyle style;
      style.isColour = isColour;
      const auto page = rectified(photoOf(camera, style), automatic(), {});
      ASSERT_TRUE(page) << page.error().message;
      ASSERT_TRUE(page->rectification) << page->rectifyNote;
      const SheetCorners truth = camera.corners();
      for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_LT((page->rectification->cornersPx[i] - truth[i]).norm(), 0.2) << pose.tiltDeg << " " << i;
      EXPECT_LT(page->rectification->bendPx, 0.5);
      EXPECT_LT(worstOfGrid(page->grey, pose), 0.3);
      EXPECT_EQ(page->colour.width, isColour ? page->grey.width : 0);
    }
  }
}

// Without the file's focal length, from the two vanishing points.
TEST(RectifiedScan, TheAspectRatioFollowsFromThePerspective) {
  for (const double focal : {20.0, 27.0, 35.0, 50.0}) {
    for (const double width : {210.0, 297.0, 150.0}) {
      const PhotoPose pose{.widthMm = width, .tiltDeg = 28.0, .panDeg = 24.0, .rollDeg = 5.0, .focal35Mm = focal};
      const PhotoCamera camera(pose, kTiltedWidth, kTiltedHeight);
      const SheetAspect seen = sheetAspect(camera.corners(), {kTiltedWidth, kTiltedHeight, std::nullopt});
      EXPECT_NEAR(seen.aspect / (width / pose.heightMm), 1.0, 0.01) << focal;
      EXPECT_LT(seen.error, 0.02);
    }
  }
}

// Tilted about one side: only the focal length tells how far.
TEST(RectifiedScan, TheFocalLengthOfTheFileCountsWhereThePerspectiveSaysLittle) {
  const PhotoPose pose{.tiltDeg = 35.0, .focal35Mm = 50.0};
  const PhotoCamera camera(pose, kTiltedWidth, kTiltedHeight);
  const double truth = pose.widthMm / pose.heightMm;
  const SheetAspect stated = sheetAspect(camera.corners(), {kTiltedWidth, kTiltedHeight, 50.0});
  EXPECT_NEAR(stated.aspect / truth, 1.0, 0.01);
  EXPECT_LT(stated.error, 0.015);
  const SheetAspect usual = sheetAspect(camera.corners(), {kTiltedWidth, kTiltedHeight, std::nullopt});
  EXPECT_GT(usual.error, 0.03) << "it is not known, and says so";
  EXPECT_LT(std::abs(std::log(usual.aspect / truth)), 4.0 * usual.error);
}

TEST(RectifiedScan, AKnownFormatSetsAspectRatioAndResolution) {
  const PhotoPose pose{.tiltDeg = 30.0, .focal35Mm = 40.0};
  const PhotoCamera camera(pose, kTiltedWidth, kTiltedHeight);
  RectifyParams params = withCorners({}, camera.corners());
  params.format = PaperFormat::A4;
  const auto page = rectified(photoOf(camera), params, {});
  ASSERT_TRUE(page);
  EXPECT_NEAR(static_cast<double>(page->grey.width) / page->grey.height, 210.0 / 297.0, 0.0015);
  ASSERT_TRUE(page->dpi);
  EXPECT_NEAR(page->grey.height / *page->dpi * 25.4, 297.0, 1e-9);
  EXPECT_EQ(page->rectification->aspectError, 0.0);
  // Lying across.
  SheetCorners turned = camera.corners();
  std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  const auto across = rectificationOf(photoOf(camera), turned, PaperFormat::A4);
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->aspect, 297.0 / 210.0, 1e-12);
}

TEST(RectifiedScan, ASheetThatIsOnlyTurnedKeepsItsResolution) {
  const PhotoCamera camera({.rollDeg = 7.0}, kTiltedWidth, kTiltedHeight);
  Scan scan = photoOf(camera);
  scan.dpi = 300.0;
  const auto made = rectificationOf(scan, camera.corners(), PaperFormat::Unknown);
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->widthPx, (camera.corners()[1] - camera.corners()[0]).norm(), 0.6);
  const auto page = rectified(std::move(scan), withCorners({}, camera.corners()), {});
  EXPECT_NEAR(*page->dpi, 300.0, 0.01);
}

TEST(RectifiedScan, NoPartOfThePageIsCoarserThanThePicture) {
  for (const PhotoPose& pose : kPoses) {
    const PhotoCamera camera(pose, kTiltedWidth, kTiltedHeight);
    const auto made = rectificationOf(photoOf(camera), camera.corners(), PaperFormat::Unknown);
    ASSERT_TRUE(made);
    const SheetMap map(*made);
    const SheetCorners& c = made->cornersPx;
    const double pictureArea = 0.5 * cross(c[2] - c[0], c[3] - c[1]);
    const double more = made->widthPx * static_cast<double>(made->heightPx) / pictureArea;
    EXPECT_LT(more, 2.01) << "the far part is not made larger without end";
    if (more > 1.99) continue;
    for (const Vec2& at : {Vec2(0, 0), Vec2(made->widthPx, 0), Vec2(made->widthPx, made->heightPx)})
      EXPECT_LT(map.slopeAt(at).operatorNorm(), 1.01);
  }
}

TEST(RectifiedScan, PlacesGoForthAndBack) {
  const PhotoCamera camera(kPoses[3], kTiltedWidth, kTiltedHeight);
  const SheetMap map(camera.corners(), 210.0, 297.0);
  for (const Vec2& mm : {Vec2(0, 0), Vec2(210, 297), Vec2(33, 120), Vec2(-20, 310)}) {
    EXPECT_LT((map.toPicture(mm) - camera.toPicture(mm)).norm(), 1e-7);
    EXPECT_LT((*map.toPage(camera.toPicture(mm)) - mm).norm(), 1e-7);
    const double h = 1e-4;
    for (int k = 0; k < 2; ++k) {
      const Vec2 step = h * Vec2::Unit(k);
      const Vec2 numeric = (map.toPicture(mm + step) - map.toPicture(mm - step)) / (2.0 * h);
      EXPECT_LT((map.slopeAt(mm).col(k) - numeric).norm(), 1e-5);
    }
  }
  // Far above the horizon of the plane.
  const PhotoCamera steep({.tiltDeg = -50.0, .fill = 0.5}, kTiltedWidth, kTiltedHeight);
  const SheetMap seen(steep.corners(), 210.0, 297.0);
  int beyond = 0;
  for (double y = -40000.0; y <= 40000.0; y += 500.0) beyond += seen.toPage({600.0, y}) ? 0 : 1;
  EXPECT_GT(beyond, 0);
}

// Where the page is made coarser, fine lines keep their mean darkness and do not beat with the grid.
TEST(RectifiedScan, TheKernelWidensWhereThePageIsCoarser) {
  GreyImage stripes(400, 400);
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) stripes.row(y)[x] = x % 2 == 0 ? 0 : 65535;
  const SheetMap map({Vec2(0, 0), Vec2(400, 0), Vec2(400, 400), Vec2(0, 400)}, 170.0, 170.0);
  const GreyImage page = resampled(stripes, map, 170, 170, {});
  for (int x = 4; x < 166; ++x) EXPECT_NEAR(page.level(x, 80), 127.5, 4.0) << x;
}

TEST(RectifiedScan, TheSameWithAnyNumberOfThreads) {
  const PhotoCamera camera(kPoses[2], 600, 800);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  PhotoStyle style;
  style.isColour = true;
  const auto a = rectified(photoOf(camera, style), automatic(), one),
             b = rectified(photoOf(camera, style), automatic(), four);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->grey, b->grey);
  EXPECT_EQ(a->colour, b->colour);
}

TEST(RectifiedScan, WithoutASheetThePictureStaysAndTheReasonIsTold) {
  const PhotoCamera camera({.tiltDeg = 20.0, .fill = 1.6}, 600, 800);  // the paper fills the picture
  const Scan picture = photoOf(camera);
  const auto page = rectified(picture, automatic(), {});
  ASSERT_TRUE(page);
  EXPECT_FALSE(page->rectification);
  EXPECT_EQ(page->grey, picture.grey);
  EXPECT_NE(page->rectifyNote.find("not rectified"), std::string::npos);
  const auto prepared = preparePage(*page, {}, {});
  ASSERT_TRUE(prepared);
  EXPECT_EQ(prepared->notes.front(), page->rectifyNote);
}

TEST(RectifiedScan, BadCornersAreRefusedWithAReason) {
  const Scan picture = photoOf(PhotoCamera({}, 600, 800));
  const auto message = [&](const SheetCorners& corners) {
    const auto page = rectified(picture, withCorners({}, corners), {});
    if (page) return std::string("accepted");
    EXPECT_EQ(page.error().code, ErrorCode::BadParameter);
    return page.error().message;
  };
  const Vec2 a(100, 100), b(500, 120), c(480, 700), d(90, 650);
  EXPECT_EQ(message({a, b, c, d}), "accepted");
  EXPECT_NE(message({a, d, c, b}).find("clockwise"), std::string::npos);
  EXPECT_NE(message({a, c, b, d}).find("cross"), std::string::npos);
  EXPECT_NE(message({a, b, Vec2(300, 200), d}).find("convex"), std::string::npos);
  EXPECT_NE(message({a, b, c, a}).find("32 px"), std::string::npos);
  EXPECT_NE(message({a, Vec2(300, 100), b, d}).find("flat"), std::string::npos);
  EXPECT_NE(message({Vec2(-300, 100), b, c, Vec2(-310, 650)}).find("outside"), std::string::npos);
  EXPECT_NE(message({a, b, Vec2(std::nan(""), 3.0), d}).find("32 px"), std::string::npos);
  EXPECT_EQ(message({Vec2(-40, 20), b, c, d}), "accepted") << "a corner that the picture just misses";
}

TEST(RectifiedScan, ASheetSeenAtAnAngleIsOfferedAndWhatWasCutIsTold) {
  const PhotoCamera camera(kPoses[2], kTiltedWidth, kTiltedHeight);
  const Scan picture = photoOf(camera);
  const auto before = preparePage(picture, {}, {});
  ASSERT_TRUE(before && before->view);
  EXPECT_TRUE(before->view->isAngled());
  EXPECT_NE(before->notes.back().find("paper.rectify=auto"), std::string::npos) << before->notes.back();
  const auto page = rectified(picture, withCorners({}, before->view->rectification.cornersPx), {});
  ASSERT_TRUE(page);
  const auto after = preparePage(*page, {}, {});
  ASSERT_TRUE(after);
  EXPECT_FALSE(after->view);
  EXPECT_NE(after->notes.front().find("was rectified"), std::string::npos);
  EXPECT_NE(after->notes.front().find("% of the picture"), std::string::npos);
  // The rim of the sheet is painted over, the drawing stays.
  ASSERT_TRUE(after->sheet && after->grey);
  EXPECT_NEAR(after->grey->level(1, 300), 225.0, 12.0);
  EXPECT_EQ(after->grey->row(300)[200], page->grey.row(300)[200]);
  PreparationParams whole;
  whole.sheet = SheetUse::Off;
  EXPECT_FALSE(preparePage(*page, whole, {})->sheet);
}

TEST(RectifiedScan, EdgesOfPaperAreToldFromDrawnLines) {
  const PhotoCamera camera({.tiltDeg = 15.0, .panDeg = 8.0}, kTiltedWidth, kTiltedHeight);
  const Vec2 low(40, 60), high(170, 240), middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const auto frame = [&](const Vec2& mm) {
    const Vec2 off = (mm - middle).cwiseAbs() - half;
    return std::abs(off.maxCoeff()) < 0.9 ? 1.0 : 0.0;
  };
  const Scan picture = renderPhoto(camera, frame);
  const auto edges = [&](double left) {
    const SheetCorners corners{camera.toPicture({left, low.y()}), camera.toPicture({high.x(), low.y()}),
                               camera.toPicture(high), camera.toPicture({left, high.y()})};
    return paperEdges(picture.grey, picture.colour, corners, 6.0, {});
  };
  EXPECT_EQ(edges(low.x()), (std::array{false, false, false, false})) << "the frame";
  EXPECT_EQ(edges(1.0), (std::array{false, false, false, true})) << "its left side moved to that of the sheet";
  const auto sheet = paperEdges(picture.grey, picture.colour, camera.corners(), 6.0, {});
  EXPECT_EQ(sheet, (std::array{true, true, true, true}));
  // What is cut off a rectified page is told.
  const auto page = rectified(picture, automatic(), {});
  ASSERT_TRUE(page && page->rectification);
  const auto prepared = preparePage(*page, {}, {});
  ASSERT_TRUE(prepared);
  EXPECT_NE(prepared->notes.back().find("A rim of"), std::string::npos) << prepared->notes.back();
}

TEST(RectifiedScan, ASheetSeenFromTheFrontIsNotOffered) {
  for (const double roll : {0.0, 5.0}) {
    const PhotoCamera camera({.rollDeg = roll}, kTiltedWidth, kTiltedHeight);
    const auto page = preparePage(photoOf(camera), {}, {});
    ASSERT_TRUE(page && page->sheet);
    EXPECT_FALSE(page->view) << roll;
  }
}

TEST(RectifiedScan, InkThatCrossesTheEdgeAndThingsUponItDoNotMoveTheCorners) {
  const PhotoCamera camera({.tiltDeg = 18.0, .panDeg = 10.0}, kTiltedWidth, kTiltedHeight);
  const auto darkness = [](const Vec2& mm) {
    const bool isBar = mm.y() > 40.0 && mm.y() < 80.0 && mm.x() > 150.0;  // runs off at the right
    const bool isClip = mm.y() < 12.0 && mm.x() > 90.0 && mm.x() < 120.0;
    return isBar || isClip ? 1.0 : 0.0;
  };
  const auto page = rectified(renderPhoto(camera, darkness), automatic(), {});
  ASSERT_TRUE(page && page->rectification) << page->rectifyNote;
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((page->rectification->cornersPx[i] - camera.corners()[i]).norm(), 0.3) << i;
}

}  // namespace
}  // namespace batten
