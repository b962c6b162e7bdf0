// SPDX-License-Identifier: GPL-3.0-or-later
// What ink the curves miss and what they invent, shown on the drawing on request.
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QLabel>
#include <QTest>

#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/session/explanation_source.h"

namespace batten {
namespace {

using test::waitUntil;

class ExplainedWindow : public test::WindowFixture {
 protected:
  /// A straight line above and a wavy one below.
  void openLines() {
    ASSERT_NO_FATAL_FAILURE(openPage(test::drawnPage({640, 400}, [](QPainter& painter) {
      painter.drawLine(QPointF(60, 80), QPointF(580, 100));
      QPainterPath wave(QPointF(60, 280));
      for (int i = 0; i < 4; ++i) {
        const double x = 60 + 130.0 * i, up = i % 2 == 0 ? -40.0 : 40.0;
        wave.cubicTo(x + 40, 280 + up, x + 90, 280 + up, x + 130, 280);
      }
      painter.drawPath(wave);
    })));
    window_->setStage(PanelStage::Curves);
    show_ = find<QCheckBox>("curves.showExplained");
    figures_ = find<FigureTable>("curves.explained");
    note_ = find<QLabel>("curves.explainedNote");
    ASSERT_TRUE(show_ && figures_ && note_);
  }
  ExplanationSource& source() { return session().explanation(); }
  bool waitForIt() {
    return waitUntil([this] { return !session().isBusy() && source().found(); });
  }
  /// The colour of the drawing at a place of the page.
  QColor colourAt(const Vec2& px) {
    auto* canvas = find<CurveCanvas>("canvas");
    QTest::mouseMove(canvas, QPoint(2, 2));
    QCoreApplication::processEvents();
    return canvas->grab().toImage().pixelColor(canvas->toWidget(px).toPoint());
  }
  int linesIn(const QColor& wanted) {
    const QImage image = find<CurveCanvas>("canvas")->grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor c = image.pixelColor(x, y);
        count += std::abs(c.red() - wanted.red()) + std::abs(c.green() - wanted.green()) +
                             std::abs(c.blue() - wanted.blue()) <
                         60
                     ? 1
                     : 0;
      }
    return count;
  }
  QCheckBox* show_ = nullptr;
  FigureTable* figures_ = nullptr;
  QLabel* note_ = nullptr;
};

TEST_F(ExplainedWindow, TellsTheSharesAndShowsTheInkThatIsMissed) {
  ASSERT_NO_FATAL_FAILURE(openLines());
  ASSERT_EQ(session().curves().size(), 2u);
  EXPECT_FALSE(source().found() || source().isComputing()) << "nobody looks";
  EXPECT_FALSE(figures_->isVisible());
  QTest::mouseClick(show_, Qt::LeftButton, Qt::NoModifier, QPoint(8, show_->height() / 2));
  ASSERT_TRUE(waitForIt());
  EXPECT_GT(source().found()->explained, 0.99);
  EXPECT_TRUE(source().found()->isExplained());
  EXPECT_EQ(source().found()->invented, 0.0);
  ASSERT_TRUE(figures_->isVisible());
  ASSERT_EQ(figures_->rows().size(), 3u);
  EXPECT_TRUE(figures_->rows()[0].cells[0].text.startsWith(QStringLiteral("9")) ||
              figures_->rows()[0].cells[0].text.startsWith(QStringLiteral("100")));
  EXPECT_FALSE(figures_->rows()[0].cells[0].warns);
  EXPECT_FALSE(note_->isVisible());
  const QColor missed(236, 112, 0);
  EXPECT_EQ(linesIn(missed), 0);

  // Without one of its curves the page is explained less, and says so.
  Recipe without = session().recipe();
  for (const TracedCurve& curve : session().curves()) {
    if (session().output().frame.pointToImage(curve.sketched.point(curve.sketched.start())).y() > 150) continue;
    PieceChoice choice;
    choice.anchorsPx = {Vec2(320, 90)};
    choice.included = false;
    without.choices.push_back(choice);
  }
  session().change(QStringLiteral("Exclude"), without);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitForIt());
  EXPECT_GT(source().found()->missed, 0.3);
  EXPECT_TRUE(figures_->rows()[0].cells[0].warns && figures_->rows()[1].cells[0].warns);
  EXPECT_TRUE(note_->isVisible() && note_->text().contains(QStringLiteral("97.0 %"))) << note_->text().toStdString();
  EXPECT_GT(linesIn(missed), 400);
  EXPECT_NEAR(colourAt({320, 90}).red(), missed.red(), 30);
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitForIt());
  EXPECT_EQ(linesIn(missed), 0);
  window_->action(ActionId::ShowExplained)->trigger();
  EXPECT_FALSE(show_->isChecked() || figures_->isVisible());
  EXPECT_FALSE(source().found()) << "nothing is kept that nobody sees";
}

TEST_F(ExplainedWindow, ShowsWhereCurvesHaveNoInk) {
  ASSERT_NO_FATAL_FAILURE(openLines());
  window_->action(ActionId::ShowExplained)->trigger();
  ASSERT_TRUE(waitForIt());
  EXPECT_TRUE(show_->isChecked());
  // Faired far beyond its ink the wave is a line over paper.
  Recipe far = session().recipe();
  far.fairing.mode = FairingMode::Target;
  far.fairing.target = FairingTarget::Degree1;
  far.fairing.toleranceMm = 6.0;
  session().change(QStringLiteral("Fair"), far);
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitForIt());
  const auto found = source().found();
  ASSERT_GT(found->invented, 0.05);
  EXPECT_TRUE(figures_->rows()[2].cells[0].warns);
  EXPECT_TRUE(note_->text().contains(QStringLiteral("no ink under it"))) << note_->text().toStdString();
  ASSERT_FALSE(found->inventions.empty());
  const auto& line = found->inventions.front().linePx;
  ASSERT_GT(line.size(), 10u);
  const QColor there = colourAt(line[line.size() / 2]);
  EXPECT_NEAR(there.red(), 190, 40);
  EXPECT_LT(there.green(), 60);
  EXPECT_NEAR(there.blue(), 140, 40);
}

TEST_F(ExplainedWindow, TheNewestRunCountsAndEscStopsIt) {
  ASSERT_NO_FATAL_FAILURE(openLines());
  window_->action(ActionId::ShowExplained)->trigger();
  for (int i = 0; i < 4; ++i) {
    Recipe recipe = session().recipe();
    recipe.filter.coefficient = i % 2 == 0 ? 3 : 2;
    session().change(QStringLiteral("Coefficient"), recipe);
  }
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitForIt());
  EXPECT_FALSE(source().isComputing());
  // A change takes it away at once: it is of other curves.
  changeSomething();
  ASSERT_TRUE(waitUntil([this] { return source().isComputing() || source().found(); }));
  session().cancel();
  EXPECT_FALSE(source().isComputing());
  session().computeAgain();
  ASSERT_TRUE(settle());
  ASSERT_TRUE(waitForIt());
  EXPECT_GT(source().found()->explained, 0.98);
}

}  // namespace
}  // namespace batten
