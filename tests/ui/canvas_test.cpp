// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QCursor>
#include <QProcess>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>
#include <cmath>
#include <random>

#include "tests/ui/rendered_scan.h"
#include "ui/canvas/curve_canvas.h"
#include "ui/canvas/layers/raster_layer.h"
#include "ui/canvas/scene/curve_shapes.h"
#include "ui/canvas/scene/tile_pyramid.h"
#include "ui/canvas/scene/view_transform.h"

namespace batten {
namespace {

using test::OpenSession;
using test::waitUntil;

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
    std::vector<std::uint8_t> grey(static_cast<std::size_t>(device.width()) * 8);
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
  QImage out(400, 40, QImage::Format_RGB32);
  renderRaster(content, 0.1, QRect(0, 0, 400, 40), out);
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
  QImage out(64 * 4, 16 * 4, QImage::Format_RGB32);
  renderRaster(content, 4.0, QRect(0, 0, out.width(), out.height()), out);
  for (const int x : {10, 56}) {
    EXPECT_EQ(qGray(out.pixel(4 * x + 2, 4 * 3 + 2)), 255);
    EXPECT_NEAR(qGray(out.pixel(4 * x + 2, 4 * 8 + 2)), 127.5, 1.0);
  }
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

/// A canvas over an open session, shown and fitted.
class CanvasTest : public testing::Test {
 protected:
  void open(const QImage& page, const Recipe& start = test::markedCornersOnly()) {
    opened = std::make_unique<OpenSession>(page, start);
    ASSERT_TRUE(opened->isReady);
    canvas = std::make_unique<CurveCanvas>(opened->session, view);
    canvas->resize(900, 640);
    // The window system's own pointer stays out of the way: its moves would mix with those of the test.
    canvas->move(120, 90);
    QCursor::setPos(2, 2);
    canvas->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(canvas.get()));
    canvas->zoomFit();
    QCoreApplication::processEvents();
  }
  EditorSession& session() { return opened->session; }
  QPoint at(double x, double y) const { return canvas->toWidget({x, y}).toPoint(); }
  void click(double x, double y, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseClick(canvas.get(), Qt::LeftButton, keys, at(x, y));
  }
  void wheel(double x, double y, int notches, Qt::KeyboardModifiers keys = {}) {
    const QPointF place = canvas->toWidget({x, y});
    QWheelEvent event(place, canvas->mapToGlobal(place), {}, {0, 120 * notches}, Qt::NoButton, keys, Qt::NoScrollPhase,
                      false);
    QCoreApplication::sendEvent(canvas.get(), &event);
  }

  ViewSettings view;
  std::unique_ptr<OpenSession> opened;
  std::unique_ptr<CurveCanvas> canvas;
};

TEST_F(CanvasTest, ClickMarksACornerAndClickRemovesIt) {
  open(test::zigzagPage());
  view.setTool(Tool::Corners);
  click(200, 103);
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  EXPECT_LT((session().recipe().cornerMarks[0].positionPx - Vec2(200, 100)).norm(), 9.0) << "snapped to the line";
  ASSERT_TRUE(opened->settle());
  ASSERT_EQ(session().output().pieces->corners.size(), 1u);
  EXPECT_LT((session().output().pieces->corners[0].positionPx - Vec2(200, 100)).norm(), 1.5);

  click(200, 100);
  EXPECT_TRUE(session().recipe().cornerMarks.empty());
  session().undoStack()->undo();
  EXPECT_EQ(session().recipe().cornerMarks.size(), 1u);
  session().undoStack()->undo();
  EXPECT_TRUE(session().recipe().cornerMarks.empty());
}

// A diamond: it counts without a mark until it is clicked, and again when that is undone or all are restored.
TEST_F(CanvasTest, AClickLeavesACertainCornerOutAndTheNextOneMarksIt) {
  open(test::zigzagPage(), Recipe{});
  view.setTool(Tool::Corners);
  ASSERT_EQ(session().output().pieces->corners.size(), 2u);
  for (const Corner& corner : session().output().pieces->corners) EXPECT_FALSE(corner.mark);
  click(200, 100);
  ASSERT_EQ(session().recipe().refusedCornersPx.size(), 1u);
  EXPECT_LT((session().recipe().refusedCornersPx[0] - Vec2(200, 100)).norm(), 1.5);
  EXPECT_TRUE(session().recipe().cornerMarks.empty()) << "found corners are never written as marks";
  ASSERT_TRUE(opened->settle());
  ASSERT_EQ(session().output().pieces->corners.size(), 1u);
  EXPECT_LT((session().output().pieces->corners[0].positionPx - Vec2(400, 300)).norm(), 1.5);
  Recipe moved = session().recipe();
  moved.threshold.strength = 1.3;
  session().change(QStringLiteral("Strength"), moved);
  ASSERT_TRUE(opened->settle());
  EXPECT_EQ(session().output().pieces->corners.size(), 1u) << "stays out when a threshold moves";
  click(200, 100);
  ASSERT_TRUE(opened->settle());
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  ASSERT_EQ(session().output().pieces->corners.size(), 2u);
  EXPECT_TRUE(session().output().pieces->corners[0].mark.has_value() !=
              session().output().pieces->corners[1].mark.has_value());
  for (int i = 0; i < 3; ++i) session().undoStack()->undo();
  ASSERT_TRUE(opened->settle());
  EXPECT_TRUE(session().recipe().refusedCornersPx.empty());
  EXPECT_EQ(session().output().pieces->corners.size(), 2u);
}

TEST_F(CanvasTest, ClickInEmptySpaceMarksNothing) {
  open(test::zigzagPage());
  view.setTool(Tool::Corners);
  click(300, 60);
  EXPECT_TRUE(session().recipe().cornerMarks.empty());
  EXPECT_EQ(session().undoStack()->count(), 0);
}

TEST_F(CanvasTest, DraggingACornerIsOneStep) {
  open(test::zigzagPage());
  view.setTool(Tool::Corners);
  click(130, 200);
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  const Vec2 before = session().recipe().cornerMarks[0].positionPx;
  QTest::mousePress(canvas.get(), Qt::LeftButton, {}, canvas->toWidget(before).toPoint());
  for (int i = 1; i <= 6; ++i) QTest::mouseMove(canvas.get(), at(130 + 7 * i, 200 - 10 * i));
  QTest::mouseRelease(canvas.get(), Qt::LeftButton, {}, at(172, 140));
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  const Vec2 after = session().recipe().cornerMarks[0].positionPx;
  EXPECT_LT((after - Vec2(172, 140)).norm(), 5.0);
  EXPECT_EQ(session().undoStack()->count(), 2);
  session().undoStack()->undo();
  EXPECT_EQ(session().recipe().cornerMarks[0].positionPx, before);
}

TEST_F(CanvasTest, DeleteRemovesTheHoveredCorner) {
  open(test::zigzagPage());
  view.setTool(Tool::Corners);
  click(200, 103);
  ASSERT_TRUE(opened->settle());
  EXPECT_TRUE(waitUntil([&] {
    QTest::mouseMove(canvas.get(), at(260, 60));
    QTest::mouseMove(canvas.get(), at(200, 100));
    QTest::keyClick(canvas.get(), Qt::Key_Delete);
    return session().recipe().cornerMarks.empty();
  }));
}

TEST_F(CanvasTest, DraggingARegionChangesItsThresholdInOneStep) {
  open(test::zigzagPage());
  view.setTool(Tool::Thresholds);
  const int region = 2 * 8 + 3;  // Columns of 80 px, rows of 50 px: x 240..320, y 100..150.
  const double before = session().output().thresholds->level[region];
  QTest::mousePress(canvas.get(), Qt::LeftButton, {}, at(280, 125));
  EXPECT_EQ(view.selectedRegion(), region);
  const QPoint from = at(280, 125);
  for (int i = 1; i <= 5; ++i) QTest::mouseMove(canvas.get(), from - QPoint(0, 4 * i));
  QTest::mouseRelease(canvas.get(), Qt::LeftButton, {}, from - QPoint(0, 20));
  const auto own = session().recipe().threshold.grid[region];
  ASSERT_TRUE(own);
  EXPECT_NEAR(*own, std::min(255.0, before + 10.0), 0.5);
  EXPECT_EQ(session().undoStack()->count(), 1);
  for (int r = 0; r < kRegions; ++r) EXPECT_EQ(session().recipe().threshold.grid[r].has_value(), r == region) << r;
  QTest::mouseDClick(canvas.get(), Qt::LeftButton, {}, at(280, 125));
  EXPECT_FALSE(session().recipe().threshold.grid[region]) << "double click: automatic";
}

TEST_F(CanvasTest, TheWheelChangesTheRegionInThatToolAndZoomsElsewhere) {
  open(test::zigzagPage());
  const double zoom = canvas->zoom();
  view.setTool(Tool::Thresholds);
  wheel(280, 125, 1);
  wheel(280, 125, 1);
  EXPECT_EQ(canvas->zoom(), zoom);
  EXPECT_TRUE(session().recipe().threshold.grid[19]);
  EXPECT_EQ(session().undoStack()->count(), 1) << "notches in a row are one step";
  wheel(280, 125, 1, Qt::ControlModifier);
  EXPECT_GT(canvas->zoom(), zoom);
  view.setTool(Tool::Select);
  const Vec2 place(280, 125);
  const QPointF before = canvas->toWidget(place);
  wheel(280, 125, 3);
  const QPointF after = canvas->toWidget(place);
  EXPECT_LE(std::hypot(after.x() - before.x(), after.y() - before.y()), 1.5);
  EXPECT_EQ(session().undoStack()->count(), 1);
}

TEST_F(CanvasTest, ShiftChoosesARectangleOfRegions) {
  open(test::zigzagPage());
  view.setTool(Tool::Thresholds);
  click(40, 25);
  click(200, 75, Qt::ShiftModifier);
  wheel(40, 25, -1);
  int own = 0;
  for (const auto& level : session().recipe().threshold.grid) own += level ? 1 : 0;
  EXPECT_EQ(own, 6) << "columns 0..2, rows 0..1";
}

TEST_F(CanvasTest, HoveringTheSelectedCurveMovesTheCommonCursor) {
  open(test::ellipsePage());
  ASSERT_NE(session().selected(), nullptr);
  const double length = session().selected()->sketchedFigures.lengthMm;
  // The combs, which hold the arc length, are made in the background.
  ASSERT_TRUE(waitUntil([&] {
    QTest::mouseMove(canvas.get(), at(320, 200));
    QTest::mouseMove(canvas.get(), at(320, 82));
    return session().cursor().has_value();
  }));
  EXPECT_GE(*session().cursor(), 0.0);
  EXPECT_LE(*session().cursor(), length * 1.01);
  EXPECT_TRUE(waitUntil([&] {
    QTest::mouseMove(canvas.get(), at(320, 200));
    return !session().cursor().has_value();
  })) << "away from the curve there is no cursor";
}

TEST_F(CanvasTest, ClickSelectsTheNearestCurve) {
  QImage page = test::zigzagPage();
  {
    QPainter painter(&page);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(30, 30, 30), 5.0));
    painter.drawLine(60, 350, 300, 360);
  }
  open(page);
  ASSERT_EQ(session().curves().size(), 2u);
  const auto first = session().selectedCurve();
  ASSERT_TRUE(waitUntil([&] {
    click(180, 355);
    return session().selectedCurve() != first;
  }));
  click(130, 203);
  EXPECT_EQ(session().selectedCurve(), first);
}

TEST_F(CanvasTest, PaintsScanCurvesAndTheDropHint) {
  {
    EditorSession empty;
    CurveCanvas bare(empty, view);
    bare.resize(600, 400);
    const QImage hint = bare.grab().toImage();
    EXPECT_FALSE(hint.isNull());
    EXPECT_NE(hint.pixel(300, 135), hint.pixel(20, 20)) << "the hint's frame stands out of the desk";
  }
  open(test::zigzagPage());
  view.setVisible(Layer::Comb, false);
  ASSERT_TRUE(waitUntil([&] {
    const QImage shown = canvas->grab().toImage();
    const QColor line = shown.pixelColor(at(130, 200));
    return line.blue() > line.red() + 40;
  })) << "the selected curve in the accent colour";
  view.setScanOnly(true);
  const QColor scan = canvas->grab().toImage().pixelColor(at(130, 200));
  EXPECT_LT(std::abs(scan.blue() - scan.red()), 8) << "the scan alone is grey";
  view.setScanOnly(false);
}

TEST_F(CanvasTest, PaintsInDevicePixels) {
  open(test::zigzagPage());
  view.setVisible(Layer::Comb, false);
  const double ratio = canvas->devicePixelRatioF();
  const bool isChild = qEnvironmentVariable("QT_SCALE_FACTOR") == QLatin1String("2");
  ASSERT_EQ(ratio, isChild ? 2.0 : ratio);
  QImage shown;
  const auto isLine = [&](double x, double y) {
    const QPointF place = canvas->toWidget({x, y}) * ratio;
    const QColor color = shown.pixelColor(place.toPoint());
    return color.blue() > color.red() + 40;
  };
  ASSERT_TRUE(waitUntil([&] {
    shown = canvas->grab().toImage();
    return isLine(130, 200);
  }));
  EXPECT_EQ(shown.size(), canvas->size() * ratio);
  EXPECT_FALSE(isLine(130, 230));
  // Painted for these pixels, not blown up: blocks of 2 x 2 that begin at even places are not all of one colour.
  int mixed = 0;
  for (int y = 0; y + 1 < shown.height(); y += 2)
    for (int x = 0; x + 1 < shown.width(); x += 2) mixed += shown.pixel(x, y) != shown.pixel(x + 1, y + 1) ? 1 : 0;
  EXPECT_GT(mixed, 500);
}

TEST(CanvasAtTwoPixelsAPoint, PaintsInDevicePixelsToo) {
  // The factor is one of the whole program.
  if (qEnvironmentVariableIsSet("QT_SCALE_FACTOR")) GTEST_SKIP() << "this is the program that the test starts";
  QProcess child;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_SCALE_FACTOR"), QStringLiteral("2"));
  child.setProcessEnvironment(environment);
  child.start(QCoreApplication::applicationFilePath(),
              {QStringLiteral("--gtest_filter=CanvasTest.PaintsInDevicePixels:CanvasTest.ClickMarksACorner*")});
  ASSERT_TRUE(child.waitForFinished(120000));
  EXPECT_EQ(child.exitCode(), 0) << child.readAllStandardOutput().toStdString();
}

TEST_F(CanvasTest, HoldingBackslashShowsTheScanAlone) {
  open(test::zigzagPage());
  QTest::keyPress(canvas.get(), Qt::Key_Backslash);
  EXPECT_TRUE(view.isScanOnly());
  QTest::keyRelease(canvas.get(), Qt::Key_Backslash);
  EXPECT_FALSE(view.isScanOnly());
}

}  // namespace
}  // namespace batten
