// SPDX-License-Identifier: GPL-3.0-or-later
// What was found on the paper before anything is traced: rulings, inks and bright lines.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QPainter>

#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

class PaperWindow : public test::WindowFixture {
 protected:
  /// A page of blue rules with a black line and a red one across them.
  QString ruledPage() const {
    QImage page(480, 400, QImage::Format_RGB32);
    page.fill(Qt::white);
    QPainter painter(&page);
    for (int y = 11; y < page.height(); y += 24) painter.fillRect(0, y, page.width(), 1, QColor(184, 204, 230));
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(25, 25, 25), 5.0));
    painter.drawLine(60, 40, 400, 330);
    painter.setPen(QPen(QColor(210, 30, 40), 5.0));
    painter.drawLine(60, 330, 250, 60);
    painter.end();
    const QString path = folder_.filePath(QStringLiteral("ruled.png"));
    EXPECT_TRUE(page.save(path));
    return path;
  }
  /// A board of grey 35 with two white lines.
  QString blackboard() const {
    QImage board(480, 400, QImage::Format_Grayscale8);
    board.fill(35);
    QPainter painter(&board);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(Qt::white, 5.0));
    painter.drawEllipse(QPointF(240.0, 200.0), 120.0, 120.0);
    painter.drawLine(40, 60, 430, 40);
    painter.end();
    const QString path = folder_.filePath(QStringLiteral("blackboard.png"));
    EXPECT_TRUE(board.save(path));
    return path;
  }
};

TEST_F(PaperWindow, RulingsAndInksAreShownInTheScanPanel) {
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openFile(ruledPage()));
  ASSERT_TRUE(settle());
  window_->setStage(PanelStage::Scan);
  ASSERT_TRUE(session().output().page);
  EXPECT_FALSE(session().output().page->rulings.empty());
  EXPECT_TRUE(find<QLabel>("scan.paperNote")->isVisible());
  EXPECT_FALSE(find<QLabel>("scan.paperNote")->text().isEmpty());
  ASSERT_EQ(session().curves().size(), 2u);
  // A press on an ink leaves it out; another brings it back.
  auto* ink = find<QAbstractButton>("scan.ink0");
  ASSERT_NE(ink, nullptr);
  EXPECT_TRUE(ink->isVisible());
  QTest::mouseClick(ink, Qt::LeftButton);
  ASSERT_TRUE(settle());
  EXPECT_LT(session().curves().size(), 2u);
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().curves().size(), 2u);
}

TEST_F(PaperWindow, BrightLinesAreFoundUnlessTheListSaysOtherwise) {
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openFile(blackboard()));
  ASSERT_TRUE(settle());
  window_->setStage(PanelStage::Scan);
  EXPECT_EQ(session().curves().size(), 2u);
  EXPECT_TRUE(find<QLabel>("scan.paperNote")->text().contains(QStringLiteral("inverted")));
  auto* lines = find<QComboBox>("paper.lines");
  ASSERT_NE(lines, nullptr);
  lines->setFocus();
  QTest::keyClick(lines, Qt::Key_Down);
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().recipe().preparation.lines, LineTone::Darker);
  EXPECT_FALSE(find<QLabel>("scan.paperNote")->text().contains(QStringLiteral("inverted")));
}

/// The histogram of a region has the levels of its threshold: those of the inverted page.
TEST_F(PaperWindow, TheHistogramOfAnInvertedPageIsInverted) {
  ASSERT_NO_FATAL_FAILURE(openWindow());
  ASSERT_NO_FATAL_FAILURE(openFile(blackboard()));
  ASSERT_TRUE(settle());
  window_->setStage(PanelStage::Threshold);
  window_->view().setSelectedRegion(63);
  auto* histogram = find<QWidget>("threshold.histogram");
  ASSERT_NE(histogram, nullptr);
  const auto isBarAt = [&](int grey) {
    const QImage image = histogram->grab().toImage();
    const auto colourAt = [&](int level) {
      const double ratio = image.devicePixelRatio();
      const double x = 6.0 + (level + 0.5) * (histogram->width() - 12) / 256.0, y = histogram->height() - 22;
      return image.pixelColor(static_cast<int>(x * ratio), static_cast<int>(y * ratio));
    };
    return colourAt(grey) != colourAt(100);
  };
  EXPECT_TRUE(isBarAt(220)) << "the board";
  EXPECT_FALSE(isBarAt(35));
}

}  // namespace
}  // namespace batten
