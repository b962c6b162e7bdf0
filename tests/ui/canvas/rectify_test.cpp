// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet that was photographed at an angle is rectified, by the corners that were found or by those that are dragged.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/image/rectify/sheet_map.h"
#include "tests/support/photo_page.h"
#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

using test::waitUntil;

constexpr int kPhotoWidth = 540, kPhotoHeight = 720;

test::PhotoCamera cameraOf(double tiltDeg) {
  return test::PhotoCamera(
      {.widthMm = 148.0, .heightMm = 210.0, .tiltDeg = tiltDeg, .panDeg = 0.5 * tiltDeg, .rollDeg = 3.0}, kPhotoWidth,
      kPhotoHeight);
}

QImage photoOf(const Scan& scan) {
  QImage image(kPhotoWidth, kPhotoHeight, QImage::Format_Grayscale8);
  for (int y = 0; y < kPhotoHeight; ++y)
    for (int x = 0; x < kPhotoWidth; ++x) image.scanLine(y)[x] = static_cast<uchar>(scan.grey.row(y)[x] / 257);
  return image;
}

/// A ring about (74, 100) mm.
bool isOnRing(const Vec2& mm, double radiusMm) {
  return std::abs(std::hypot(mm.x() - 74.0, mm.y() - 100.0) - radiusMm) < 0.8;
}

/// Each tilt is rendered once: most of the time of these tests went into it.
const QImage& photo(double tiltDeg) {
  static std::map<double, QImage> rendered;
  QImage& image = rendered[tiltDeg];
  if (image.isNull())
    image = photoOf(renderPhoto(cameraOf(tiltDeg), [](const Vec2& mm) { return isOnRing(mm, 45.0) ? 1.0 : 0.0; }));
  return image;
}

class RectifyWindow : public test::WindowFixture {
 protected:
  void open(double tiltDeg) {
    ASSERT_NO_FATAL_FAILURE(openPage(photo(tiltDeg)));
    window_->setStage(PanelStage::Scan);
    rectify_ = find<QAbstractButton>("scan.rectify");
    whole_ = find<QAbstractButton>("scan.wholePicture");
    note_ = find<QLabel>("scan.rectifyNote");
    ASSERT_TRUE(rectify_ && whole_ && note_);
  }
  bool isRectified() { return session().scan()->rectification.has_value(); }
  /// Width over height of what the first curve's points span.
  double aspect() {
    Vec2 low(1e9, 1e9), high(-1e9, -1e9);
    for (const PiecePoint& p : session().output().pieces->pieces.front().points) {
      low = low.cwiseMin(p.at);
      high = high.cwiseMax(p.at);
    }
    return (high - low).x() / (high - low).y();
  }
  void drag(const Vec2& from, const Vec2& to) {
    QCoreApplication::processEvents();
    auto* canvas = find<CurveCanvas>("canvas");
    const QPoint a = canvas->toWidget(from).toPoint(), b = canvas->toWidget(to).toPoint();
    QTest::mousePress(canvas, Qt::LeftButton, {}, a);
    QTest::mouseMove(canvas, (a + b) / 2);
    QTest::mouseMove(canvas, b);
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, b);
  }
  QAbstractButton* rectify_ = nullptr;
  QAbstractButton* whole_ = nullptr;
  QLabel* note_ = nullptr;
};

TEST_F(RectifyWindow, IsOfferedDoneKeepsTheMarksAndIsUndone) {
  open(25.0);
  ASSERT_TRUE(rectify_->isVisible()) << note_->text().toStdString();
  EXPECT_TRUE(note_->text().contains(QStringLiteral("at an angle"))) << note_->text().toStdString();
  EXPECT_FALSE(whole_->isVisible());
  // A mark on the ring: it stays on it.
  const Vec2 onRing = cameraOf(25.0).toPicture(Vec2(74 + 45, 100));
  Recipe marked = session().recipe();
  marked.cornerMarks.push_back({onRing});
  session().change(QStringLiteral("Mark"), marked);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(session().output().pieces->lostMarks.empty());
  EXPECT_GT(std::abs(aspect() - 1.0), 0.02);
  const int step = session().undoStack()->index();
  const auto picture = session().scan();
  window_->resize(1366, 720);
  EXPECT_TRUE(waitUntil([&] { return rectify_->visibleRegion().boundingRect() == rectify_->rect(); }, 3000))
      << "seen in a low window without scrolling";
  rectify_->click();
  EXPECT_EQ(session().undoStack()->index(), step + 1);
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  ASSERT_FALSE(session().output().error) << session().output().error->message;
  EXPECT_NEAR(aspect(), 1.0, 0.012);
  EXPECT_TRUE(session().output().pieces->lostMarks.empty());
  ASSERT_EQ(session().recipe().cornerMarks.size(), 1u);
  const SheetMap map(*session().scan()->rectification);
  EXPECT_LT((map.toPicture(session().recipe().cornerMarks[0].positionPx) - onRing).norm(), 1e-6);
  EXPECT_FALSE(rectify_->isVisible());
  EXPECT_TRUE(whole_->isVisible());
  EXPECT_TRUE(note_->text().contains(QStringLiteral("% of the picture was cut off"))) << note_->text().toStdString();
  EXPECT_EQ(session().picture(), picture);

  session().undoStack()->undo();
  ASSERT_TRUE(waitUntil([&] { return !isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().scan(), picture) << "no copy of it";
  EXPECT_EQ(session().recipe().cornerMarks[0].positionPx, onRing);
  session().undoStack()->redo();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  EXPECT_NEAR(aspect(), 1.0, 0.012);
  whole_->click();
  ASSERT_TRUE(waitUntil([&] { return !isRectified() && !session().isBusy(); }));
  EXPECT_LT((session().recipe().cornerMarks[0].positionPx - onRing).norm(), 1e-6);
}

TEST_F(RectifyWindow, MarksMoveOnceHoweverOftenItIsAskedForBeforeThePageIsThere) {
  open(25.0);
  const Vec2 onRing = cameraOf(25.0).toPicture(Vec2(74 + 45, 100));
  Recipe marked = session().recipe();
  marked.cornerMarks.push_back({onRing});
  session().change(QStringLiteral("Mark"), marked);
  ASSERT_TRUE(settle());
  for (int i = 0; i < 2; ++i) rectify_->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  const auto markOnPicture = [&] {
    return Vec2(SheetMap(*session().scan()->rectification).toPicture(session().recipe().cornerMarks.at(0).positionPx));
  };
  EXPECT_LT((markOnPicture() - onRing).norm(), 1e-6);
  auto* format = find<QComboBox>("paper.format");
  format->setFocus();
  for (int i = 0; i < 2; ++i) QTest::keyClick(format, Qt::Key_Down);
  ASSERT_TRUE(waitUntil(
      [&] { return session().scan()->rectification && session().scan()->rectification->dpi && !session().isBusy(); }));
  EXPECT_LT((markOnPicture() - onRing).norm(), 1e-6);
  for (int i = 0; i < 2; ++i) whole_->click();
  ASSERT_TRUE(waitUntil([&] { return !isRectified() && !session().isBusy(); }));
  EXPECT_LT((session().recipe().cornerMarks.at(0).positionPx - onRing).norm(), 1e-6);
}

TEST_F(RectifyWindow, TheFormatSetsTheScale) {
  open(25.0);
  rectify_->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  auto* format = find<QComboBox>("paper.format");
  ASSERT_TRUE(format->isVisible());
  format->setFocus();
  for (int i = 0; i < 2; ++i) QTest::keyClick(format, Qt::Key_Down);
  ASSERT_EQ(format->currentText(), QStringLiteral("A5"));
  ASSERT_TRUE(waitUntil(
      [&] { return session().scan()->rectification && session().scan()->rectification->dpi && !session().isBusy(); }));
  const PageFrame frame = frameFor(*session().scan(), session().recipe());
  EXPECT_NEAR(frame.heightPx * frame.mmPerPx, 210.0, 0.01);
  EXPECT_NEAR(frame.widthPx * frame.mmPerPx, 148.0, 0.3);
}

TEST_F(RectifyWindow, CornersAreDraggedAndEnterRectifies) {
  open(0.0);
  EXPECT_FALSE(rectify_->isVisible()) << "seen from the front";
  window_->action(ActionId::ToolSheet)->trigger();
  EXPECT_EQ(window_->stage(), PanelStage::Scan);
  EXPECT_TRUE(rectify_->isVisible());
  const Vec2 start(0.1 * kPhotoWidth, 0.1 * kPhotoHeight), end(140, 110);
  drag(start, end);
  ASSERT_TRUE(window_->view().sheetCorners());
  EXPECT_LT(((*window_->view().sheetCorners())[0] - end).norm(), 2.0);
  EXPECT_EQ(session().recipe().preparation.rectify.use, RectifyUse::Off) << "until Enter";
  QTest::keyClick(find<CurveCanvas>("canvas"), Qt::Key_Return);
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  EXPECT_LT((session().scan()->rectification->cornersPx[0] - end).norm(), 2.0);
  EXPECT_EQ(window_->view().tool(), Tool::Select);
  // On the rectified page the corners are its own; what cannot be a sheet is refused with the reason.
  const Recipe before = session().recipe();
  window_->action(ActionId::ToolSheet)->trigger();
  const double width = session().scan()->grey.width, height = session().scan()->grey.height;
  window_->view().setSheetCorners(SheetCorners{Vec2(0, 0), Vec2(width, height), Vec2(width, 0), Vec2(0, height)});
  rectify_->click();
  EXPECT_EQ(session().recipe(), before);
  EXPECT_TRUE(note_->text().contains(QStringLiteral("cross"))) << note_->text().toStdString();
  ASSERT_TRUE(settle());
}

TEST_F(RectifyWindow, ARecipeWithCornersOpensRectifiedAndFailsWithAReasonOnAnotherPicture) {
  open(25.0);
  rectify_->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  const Recipe kept = session().recipeToSave();
  const double before = aspect();
  session().restore(path_, kept);
  ASSERT_TRUE(waitUntil([&] { return session().wasRestored() && isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().recipe().preparation.rectify, kept.preparation.rectify);
  EXPECT_NEAR(aspect(), before, 1e-12);

  Recipe wrong = kept;
  for (Vec2& corner : wrong.preparation.rectify.cornersPx) corner += Vec2(3000.0, 0.0);
  session().change(QStringLiteral("Wrong"), wrong);
  ASSERT_TRUE(waitUntil([&] { return session().output().error.has_value() && !session().isBusy(); }));
  EXPECT_NE(session().output().error->message.find("outside the picture"), std::string::npos);
  session().undoStack()->undo();
  ASSERT_TRUE(waitUntil([&] { return !session().output().error && !session().isBusy(); }));
  EXPECT_NEAR(aspect(), before, 1e-12);
}

// Back on the picture, what was found on it is still there.
TEST_F(RectifyWindow, UndoneThePictureIsPreparedAlready) {
  open(25.0);
  const auto page = session().output().page;
  ASSERT_TRUE(page);
  rectify_->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  const auto rectifiedPage = session().output().page;
  session().undoStack()->undo();
  ASSERT_TRUE(waitUntil([&] { return !isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().output().page, page);
  session().undoStack()->redo();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().output().page, rectifiedPage);
}

// The places of a recipe are those of the page that it makes, also where that page is still to be found.
TEST_F(RectifyWindow, CurvesKeepTheirNumbersWhereTheRecipeLooksForTheSheet) {
  open(25.0);
  rectify_->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  Recipe kept = session().recipeToSave();
  ASSERT_FALSE(kept.curveNumbers.curves.empty());
  kept.preparation.rectify = {RectifyUse::Automatic, {}, kept.preparation.rectify.format};
  for (NumberedCurve& curve : kept.curveNumbers.curves) curve.number += 40;
  kept.curveNumbers.lastGiven += 40;
  session().restore(path_, kept);
  ASSERT_TRUE(waitUntil([&] { return session().wasRestored() && isRectified() && !session().isBusy(); }));
  const CurveNumbers after = session().recipeToSave().curveNumbers;
  EXPECT_EQ(after.lastGiven, kept.curveNumbers.lastGiven) << "no curve is new";
  ASSERT_EQ(after.curves.size(), kept.curveNumbers.curves.size());
  for (std::size_t i = 0; i < after.curves.size(); ++i)
    EXPECT_EQ(after.curves[i].number, kept.curveNumbers.curves[i].number);
}

// Nothing is cut off along a frame that was drawn and chosen as the rectangle, other than along the edges of a sheet.
TEST_F(RectifyWindow, NothingIsCutOffAlongADrawnFrameThatIsChosenAsTheRectangle) {
  const Vec2 low(30, 50), high(118, 160);
  const auto frame = [&](const Vec2& mm) {
    const double offX = std::abs(mm.x() - 0.5 * (low.x() + high.x())) - 0.5 * (high.x() - low.x());
    const double offY = std::abs(mm.y() - 0.5 * (low.y() + high.y())) - 0.5 * (high.y() - low.y());
    return isOnRing(mm, 30.0) || std::abs(std::max(offX, offY)) < 1.2 ? 1.0 : 0.0;
  };
  const test::PhotoCamera camera = cameraOf(25.0);
  ASSERT_NO_FATAL_FAILURE(openPage(photoOf(renderPhoto(camera, frame))));
  window_->setStage(PanelStage::Scan);
  window_->action(ActionId::ToolSheet)->trigger();
  window_->view().setSheetCorners(SheetCorners{camera.toPicture(low), camera.toPicture({high.x(), low.y()}),
                                               camera.toPicture(high), camera.toPicture({low.x(), high.y()})});
  find<QAbstractButton>("scan.rectify")->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  ASSERT_FALSE(session().output().error) << session().output().error->message;
  EXPECT_EQ(session().recipe().preparation.sheet, SheetUse::Off);
  ASSERT_TRUE(session().output().page);
  EXPECT_FALSE(session().output().page->sheet);
  const GreyImage& grey = tracedGrey(*session().scan(), session().output());
  EXPECT_LT(grey.level(grey.width / 2, 0), 160.0) << "half the line of the frame";
  find<QAbstractButton>("scan.wholePicture")->click();
  ASSERT_TRUE(waitUntil([&] { return !isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().recipe().preparation.sheet, SheetUse::CutOff) << "the frame is no longer the rectangle";
  session().undoStack()->undo();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().recipe().preparation.sheet, SheetUse::Off);
  session().undoStack()->undo();
  ASSERT_TRUE(waitUntil([&] { return !isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().recipe().preparation.sheet, SheetUse::CutOff);
  find<QAbstractButton>("scan.rectify")->click();
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  EXPECT_EQ(session().recipe().preparation.sheet, SheetUse::CutOff) << "the sheet itself";
}

TEST_F(RectifyWindow, EnterAsksForCornersWhereNoneWereFoundOrMoved) {
  open(0.0);
  window_->action(ActionId::ToolSheet)->trigger();
  const Recipe before = session().recipe();
  auto* canvas = find<CurveCanvas>("canvas");
  QTest::keyClick(canvas, Qt::Key_Return);
  EXPECT_EQ(session().recipe(), before);
  EXPECT_EQ(window_->view().tool(), Tool::Sheet);
  EXPECT_TRUE(note_->isVisible() && note_->text().contains(QStringLiteral("Drag the corners")))
      << note_->text().toStdString();
  // The corners of a rectified page are its own: Enter leaves them.
  drag({0.1 * kPhotoWidth, 0.1 * kPhotoHeight}, {140, 110});
  QTest::keyClick(canvas, Qt::Key_Return);
  ASSERT_TRUE(waitUntil([&] { return isRectified() && !session().isBusy(); }));
  const Recipe rectified = session().recipe();
  const int step = session().undoStack()->index();
  window_->action(ActionId::ToolSheet)->trigger();
  QTest::keyClick(canvas, Qt::Key_Return);
  EXPECT_EQ(session().recipe(), rectified);
  EXPECT_EQ(session().undoStack()->index(), step);
  EXPECT_EQ(window_->view().tool(), Tool::Select);
}

}  // namespace
}  // namespace batten
