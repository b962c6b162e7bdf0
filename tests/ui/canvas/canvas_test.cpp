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

namespace batten {
namespace {

using test::OpenSession;
using test::waitUntil;

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

TEST_F(CanvasTest, AnArrowShowsTheSelectedCurvesDirectionWithoutItsComb) {
  open(test::zigzagPage());
  view.setVisible(Layer::Comb, false);
  ASSERT_TRUE(session().selectedCurve());
  // In the body of the arrow, beside the curve: 14.5 px from its start, on the first of its straight strokes.
  const auto isArrowAt = [&](const QImage& shown, const Vec2& startPx, const Vec2& nextPx) {
    const QPointF start = canvas->toWidget(startPx), next = canvas->toWidget(nextPx);
    const QPointF along = (next - start) / std::hypot(next.x() - start.x(), next.y() - start.y());
    const QPointF beside = start + 14.5 * along + 2.5 * QPointF(-along.y(), along.x());
    const QColor color = shown.pixelColor((beside * canvas->devicePixelRatioF()).toPoint());
    return color.blue() > color.red() + 100;  // the curve's pale halo, which lies there too, is less blue
  };
  const auto isArrowShown = [&] {
    const QImage shown = canvas->grab().toImage();
    return isArrowAt(shown, {60, 300}, {200, 100}) || isArrowAt(shown, {580, 80}, {400, 300});
  };
  EXPECT_TRUE(waitUntil(isArrowShown));
  view.setVisible(Layer::Curve, false);
  view.setVisible(Layer::Faired, false);
  EXPECT_FALSE(isArrowShown()) << "no curve is shown, so no arrow";
  view.setVisible(Layer::Faired, true);
  view.setVisible(Layer::Curve, true);
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
