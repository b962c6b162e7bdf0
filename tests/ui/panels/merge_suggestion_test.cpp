// SPDX-License-Identifier: GPL-3.0-or-later
// The drawing is asked how far its strokes are to be merged.
#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <cmath>

#include "tests/ui/window_fixture.h"

namespace batten {
namespace {

using test::waitUntil;

/// Lines of one stroke each, or drawn three times over one another.
QImage strokesPage(int count) {
  return test::drawnPage({700, 420}, [count](QPainter& painter) {
    painter.setPen(QPen(QColor(30, 30, 30), 3.0, Qt::SolidLine, Qt::RoundCap));
    for (int k = 0; k < count; ++k) {
      QPolygonF line;
      for (int i = 12 * k; i <= 600 - 9 * k; ++i)
        line.append(QPointF(50.0 + i, 210.0 - 60.0 * std::sin(0.008 * i) + 9.0 * std::sin(0.021 * i + 2.1 * k)));
      painter.drawPolyline(line);
    }
    painter.drawLine(QPointF(60, 390), QPointF(640, 380));
  });
}

class MergeButton : public test::WindowFixture {
 protected:
  void open(const QImage& page) {
    ASSERT_NO_FATAL_FAILURE(openPage(page));
    window_->setStage(PanelStage::Edges);
    ask_ = find<QPushButton>("edges.suggestMerge");
    note_ = find<QLabel>("edges.suggestMerge.note");
    ASSERT_TRUE(ask_ && note_);
    rest_ = note_->text();
  }
  double strength() { return session().recipe().edges.mergeWidths; }
  static constexpr int kLimitMs = 180000;  // outlines of overdrawn strokes take half a minute on a busy machine
  bool answered() {
    return waitUntil([this] { return !session().isWorking(); }, kLimitMs);
  }
  QPushButton* ask_ = nullptr;
  QLabel* note_ = nullptr;
  QString rest_;
};

TEST_F(MergeButton, SetsTheStrengthInOneStepAndSaysWhy) {
  open(strokesPage(3));
  const int step = session().undoStack()->index();
  const std::size_t before = session().output().contours->contours.size();
  EXPECT_GT(before, 2u);
  ask_->click();
  EXPECT_TRUE(session().isWorking());
  EXPECT_NE(note_->text(), rest_);
  EXPECT_EQ(strength(), 0.0) << "the answer comes later";
  ASSERT_TRUE(waitUntil([this] { return strength() > 0.0; }));
  EXPECT_EQ(session().undoStack()->index(), step + 1);
  EXPECT_TRUE(note_->text().contains(QStringLiteral("become 2 lines."))) << note_->text().toStdString();
  EXPECT_TRUE(note_->text().startsWith(QString::number(strength()))) << note_->text().toStdString();
  ASSERT_TRUE(answered());
  EXPECT_EQ(session().output().contours->contours.size(), 2u);

  const double found = strength();
  session().undoStack()->undo();
  EXPECT_EQ(strength(), 0.0);
  EXPECT_EQ(note_->text(), rest_) << "it no longer holds";
  session().undoStack()->redo();
  ask_->click();  // the same again: nothing to change
  ASSERT_TRUE(answered());
  EXPECT_EQ(strength(), found);
  EXPECT_EQ(session().undoStack()->index(), step + 1);
  EXPECT_NE(note_->text(), rest_);
}

TEST_F(MergeButton, OffersTheCurvesThatWereMeant) {
  open(strokesPage(3));
  auto* offer = find<QPushButton>("edges.offerIntent");
  ASSERT_TRUE(offer);
  EXPECT_FALSE(offer->isVisible());
  ask_->click();
  ASSERT_TRUE(answered());
  ASSERT_TRUE(offer->isVisible()) << note_->text().toStdString();
  EXPECT_FALSE(session().recipe().edges.intent) << "it is only offered";
  offer->click();
  EXPECT_TRUE(session().recipe().edges.intent);
  EXPECT_FALSE(offer->isVisible());
  ASSERT_TRUE(answered());
  EXPECT_TRUE(session().output().contours->report.isGrouped);
  EXPECT_EQ(session().output().contours->contours.size(), 2u);
  session().undoStack()->undo();
  EXPECT_FALSE(session().recipe().edges.intent);
  EXPECT_TRUE(offer->isVisible());
}

TEST_F(MergeButton, OffersNothingOnACleanPage) {
  open(strokesPage(1));
  ask_->click();
  ASSERT_TRUE(answered());
  auto* offer = find<QPushButton>("edges.offerIntent");
  ASSERT_TRUE(offer);
  EXPECT_FALSE(offer->isVisible());
}

TEST_F(MergeButton, ChangesNothingWhereNoStrokesAreOverdrawn) {
  open(strokesPage(1));
  const Recipe before = session().recipe();
  ask_->click();
  ASSERT_TRUE(answered());
  EXPECT_TRUE(note_->text().startsWith(QStringLiteral("No overdrawn strokes"))) << note_->text().toStdString();
  EXPECT_EQ(session().recipe(), before);
  EXPECT_EQ(session().undoStack()->index(), 0);
}

TEST_F(MergeButton, TheNoteStaysAsLongAsItHolds) {
  open(strokesPage(1));
  ask_->click();
  const QString looking = note_->text();
  Recipe other = session().recipe();
  other.fairing.toleranceMm *= 2.0;  // nothing that the lines depend on
  session().change(QStringLiteral("Tolerance"), other);
  EXPECT_EQ(note_->text(), looking);
  ASSERT_TRUE(answered());
  const QString said = note_->text();
  EXPECT_TRUE(said.startsWith(QStringLiteral("No overdrawn strokes"))) << said.toStdString();
  other.fairing.toleranceMm *= 2.0;
  session().change(QStringLiteral("Tolerance"), other);
  EXPECT_EQ(note_->text(), said);
  other.edges.mode = EdgeMode::Outline;
  session().change(QStringLiteral("Outline"), other);
  EXPECT_EQ(note_->text(), rest_);
}

TEST_F(MergeButton, EscStopsIt) {
  open(strokesPage(3));
  ASSERT_TRUE(answered()) << "the targets are there, too";
  ask_->click();
  ASSERT_TRUE(session().isWorking());
  session().cancel();
  EXPECT_FALSE(session().isWorking());
  EXPECT_FALSE(session().isStopped()) << "nothing on display is missing";
  EXPECT_EQ(note_->text(), rest_);
  const int step = session().undoStack()->index();
  ask_->click();  // and it may be asked again
  EXPECT_TRUE(waitUntil([this] { return strength() > 0.0; }));
  ASSERT_TRUE(answered());
  EXPECT_EQ(session().undoStack()->index(), step + 1) << "the stopped one has changed nothing";
}

// The answer is about the drawing as it is by then, not as it was.
TEST_F(MergeButton, AChangeMeanwhileIsLookedAtAnew) {
  open(strokesPage(3));
  ask_->click();
  Recipe outlines = session().recipe();
  outlines.edges.mode = EdgeMode::Outline;
  session().change(QStringLiteral("Outline"), outlines);
  ASSERT_TRUE(answered());
  EXPECT_TRUE(note_->text().startsWith(QStringLiteral("No centre lines are traced"))) << note_->text().toStdString();
  EXPECT_EQ(strength(), 0.0);
}

}  // namespace
}  // namespace batten
