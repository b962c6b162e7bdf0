// SPDX-License-Identifier: GPL-3.0-or-later
// What there is to paint: the view, the tiles, the shapes of curves.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/ui/rendered_scan.h"
#include "ui/canvas/layers/raster_layer.h"
#include "ui/canvas/scene/curve_shapes.h"
#include "ui/canvas/scene/tile_pyramid.h"
#include "ui/canvas/scene/view_transform.h"

namespace batten {
namespace {

ViewTransform someView(double ratio) {
  ViewTransform view;
  view.setImageSize({2000, 1000});
  view.setViewSize(QSize(static_cast<int>(800 * ratio), static_cast<int>(600 * ratio)), ratio);
  view.fit();
  return view;
}

TEST(ViewTransform, FitsTheWholeImage) {
  for (const double ratio : {1.0, 1.5, 2.0}) {
    const ViewTransform view = someView(ratio);
    const QPointF from = view.toWidget({0, 0}), to = view.toWidget({2000, 1000});
    EXPECT_NEAR(from.x(), ViewTransform::kFitMarginPx, 1.0);
    EXPECT_NEAR(to.x(), 800 - ViewTransform::kFitMarginPx, 1.0);
    EXPECT_NEAR(from.y() + to.y(), 600, 1.5);
  }
}

// Over targets and plots, on a small screen: an edge as wide as elsewhere would take a sixth of the height.
TEST(ViewTransform, ALowViewIsFilled) {
  for (const double ratio : {1.0, 2.0}) {
    ViewTransform view;
    view.setImageSize({1500, 1000});
    view.setViewSize(QSize(static_cast<int>(900 * ratio), static_cast<int>(300 * ratio)), ratio);
    view.fit();
    EXPECT_NEAR(view.toWidget({0, 0}).y(), 12.0, 1.0);
    EXPECT_NEAR(view.toWidget({1500, 1000}).y(), 288.0, 1.0);
  }
}

TEST(ViewTransform, WidgetAndImageAreInverse) {
  ViewTransform view = someView(1.5);
  view.zoomAt(3.7, {200, 150});
  view.pan({33.3, -12.7});
  const Vec2 place(812.25, 431.5);
  EXPECT_NEAR((view.toImage(view.toWidget(place)) - place).norm(), 0.0, 1e-9);
}

TEST(ViewTransform, ZoomKeepsThePlaceUnderTheMouse) {
  ViewTransform view = someView(2.0);
  const QPointF mouse(311, 222);
  const Vec2 before = view.toImage(mouse);
  for (const double zoom : {1.0, 5.0, 40.0, 3.0}) {
    view.zoomAt(zoom, mouse);
    // The origin is a whole device pixel: half a device pixel is what rounding may move.
    EXPECT_LE((view.toImage(mouse) - before).norm(), 4 * 0.75 / std::min(zoom, 1.0) + 1e-9) << zoom;
  }
  EXPECT_EQ(view.zoom(), 3.0);
}

TEST(ViewTransform, PansByFractionsWithoutLosingThem) {
  ViewTransform view = someView(1.0);
  view.zoomAt(4.0, view.centre());
  const QPoint before = view.origin();
  for (int i = 0; i < 10; ++i) view.pan({0.3, 0.0});
  EXPECT_EQ(view.origin().x() - before.x(), 3);
}

TEST(ViewTransform, NeverLosesTheImage) {
  ViewTransform view = someView(1.0);
  view.pan({1e6, -1e6});
  const QRectF page(view.toWidget({0, 0}), view.toWidget({2000, 1000}));
  EXPECT_TRUE(page.intersects(QRectF(0, 0, 800, 600)));
  view.zoomAt(1e9, {0, 0});
  EXPECT_EQ(view.zoom(), ViewTransform::kMaxZoom);
}

std::shared_ptr<const Scan> ramp(int width, int height) {
  auto scan = std::make_shared<Scan>();
  scan->grey = GreyImage(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) scan->grey.row(y)[x] = static_cast<std::uint16_t>(65535.0 * x / (width - 1));
  return scan;
}

TEST(TilePyramid, EveryLevelShowsTheSameRamp) {
  const auto scan = ramp(3001, 1503);
  const auto pyramid = buildPyramid(scan, RunContext{});
  ASSERT_TRUE(pyramid);
  ASSERT_GE(pyramid->levels.size(), 3u);
  for (const double zoom : {4.0, 1.0, 0.6, 0.3, 0.11, 0.05}) {
    const QRect device(0, 0, static_cast<int>(3001 * zoom), 8);
    std::vector<std::uint8_t> grey(device.width() * 8);
    sampleGrey(*pyramid, zoom, device, grey.data());
    for (int i = 2; i + 2 < device.width(); i += 7) {
      const double expected = 255.0 * ((i + 0.5) / zoom - 0.5) / 3000.0;
      EXPECT_NEAR(grey[i], expected, 2.6) << "zoom " << zoom << " at " << i;
    }
  }
}

TEST(TilePyramid, TheCoarseOneIsThereAtOnceAndLooksAlike) {
  const auto coarse = coarsePyramid(ramp(3001, 1503));
  ASSERT_EQ(coarse->levels.size(), 1u);
  const double zoom = 0.2;
  std::vector<std::uint8_t> grey(600);
  sampleGrey(*coarse, zoom, QRect(0, 100, 600, 1), grey.data());
  for (std::size_t i = 20; i < 580; i += 20)
    EXPECT_NEAR(grey[i], 255.0 * (static_cast<double>(i) + 0.5) / zoom / 3001.0, 4.0) << i;
}

TEST(RasterLayer, CountsInkAcrossWords) {
  BitImage bits(300, 2);
  std::mt19937 random(7);
  for (int x = 0; x < 300; ++x) bits.set(x, 1, random() % 3 == 0);
  for (const auto& [x0, x1] : {std::pair{0, 300}, {0, 64}, {63, 65}, {5, 5}, {60, 200}, {128, 192}, {299, 300}}) {
    int naive = 0;
    for (int x = x0; x < x1; ++x) naive += bits.at(x, 1) ? 1 : 0;
    EXPECT_EQ(inkInRow(bits, 1, x0, x1), naive) << x0 << " " << x1;
  }
}

TEST(RasterLayer, ThinInkIsStillSeenFarAway) {
  auto bits = std::make_shared<BitImage>(4000, 400);
  for (int y = 0; y < 400; ++y) bits->set(2001, y, true);
  RasterContent content;
  content.mask = bits;
  content.pageWidth = 4000, content.pageHeight = 400;
  const QImage out = renderRaster(content, 0.1, QRect(0, 0, 400, 40));
  EXPECT_LT(qGray(out.pixel(200, 20)), qGray(out.pixel(100, 20)) - 10);
  EXPECT_EQ(out.pixel(199, 20), out.pixel(100, 20));
}

TEST(RasterLayer, FlattenedPaperIsWhiteAndInkKeepsItsShare) {
  auto scan = std::make_shared<Scan>();
  scan->grey = GreyImage(64, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 64; ++x) scan->grey.row(y)[x] = static_cast<std::uint16_t>((x < 32 ? 100 : 200) * 257);
  for (int x = 0; x < 64; ++x) scan->grey.row(8)[x] = static_cast<std::uint16_t>((x < 32 ? 50 : 100) * 257);
  auto paper = std::make_shared<PaperBackground>();
  paper->cellPx = 8, paper->columns = 8, paper->rows = 2;
  for (int i = 0; i < 16; ++i) paper->grey.push_back(i % 8 < 4 ? 100.0F : 200.0F);
  RasterContent content;
  content.pyramid = coarsePyramid(scan);
  content.showsPicture = true;
  content.paper = paper;
  content.pageWidth = 64, content.pageHeight = 16;
  const QImage out = renderRaster(content, 4.0, QRect(0, 0, 64 * 4, 16 * 4));
  for (const int x : {10, 56}) {
    EXPECT_EQ(qGray(out.pixel(4 * x + 2, 4 * 3 + 2)), 255);
    EXPECT_NEAR(qGray(out.pixel(4 * x + 2, 4 * 8 + 2)), 127.5, 1.0);
  }
}

TEST(RasterLayer, AColourScanIsShownInItsColoursAtEveryZoom) {
  auto scan = std::make_shared<Scan>(*ramp(1600, 900));
  scan->colour = ColourImage(1600, 900);
  for (int y = 0; y < 900; ++y)
    for (int x = 0; x < 1600; ++x) scan->colour.row(y)[x] = x < 800 ? Rgb8{200, 30, 40} : Rgb8{20, 60, 180};
  RasterContent content;
  content.showsPicture = true;
  content.pageWidth = 1600, content.pageHeight = 900;
  const auto colourAt = [&](double zoom, int x) {
    return renderRaster(content, zoom, QRect(0, 0, static_cast<int>(1600 * zoom), 4))
        .pixel(static_cast<int>(x * zoom), 2);
  };
  for (const auto& pyramid : {coarsePyramid(scan), buildPyramid(scan, RunContext{})}) {
    content.pyramid = pyramid;
    for (const double zoom : {0.1, 0.4, 1.0, 5.0}) {
      EXPECT_EQ(colourAt(zoom, 300), qRgb(200, 30, 40)) << zoom;
      EXPECT_EQ(colourAt(zoom, 1300), qRgb(20, 60, 180)) << zoom;
    }
  }
  content.tones.emplace();  // the log picture is one of grey values
  content.tones->fill(77);
  EXPECT_EQ(colourAt(0.4, 300), qRgb(77, 77, 77));
}

TEST(CurveShapes, SampledLinesStayWithinTheTolerance) {
  const auto curve = NurbsCurve::make(3, {0, 0, 0, 0, 1, 2, 2, 2, 2}, {{0, 0}, {2, 30}, {20, 40}, {30, -10}, {60, 5}});
  ASSERT_TRUE(curve);
  const PageFrame frame{800, 600, 0.1};
  for (const double tolerance : {1.0, 0.1, 0.01}) {
    const QPainterPath path = sampledPath(*curve, frame, tolerance);
    double worst = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const auto distance = distanceTo(path, frame.pointToImage(curve->point(2.0 * i / 1000)));
      ASSERT_TRUE(distance);
      worst = std::max(worst, *distance);
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_LT(path.elementCount(), 60.0 / std::sqrt(tolerance) + 8);
  }
}

}  // namespace
}  // namespace batten
