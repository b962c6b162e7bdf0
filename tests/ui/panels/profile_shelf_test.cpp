// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/stages/profile_shelf.h"

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QDir>
#include <QDragEnterEvent>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QStandardPaths>
#include <QTimer>
#include <cmath>
#include <numbers>

#include "core/fairing/profile/like_profile.h"
#include "tests/ui/window_fixture.h"
#include "ui/new_drawing_dialog.h"
#include "ui/session/edits/like_edits.h"
#include "ui/session/files/profile_library.h"

namespace batten {
namespace {

using test::waitUntil;

/// Two lines drawn with the pen, and a saved profile: the course of curvature of a clothoid.
class Shelf : public test::WindowFixture {
 protected:
  void SetUp() override {
    // A library of its own, beside those of tests that run at the same time.
    before_ = QCoreApplication::applicationName();
    QCoreApplication::setApplicationName(
        before_ + QString::fromLatin1(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::vector<ProfilePoint> shape;
    for (int i = 0; i <= 20; ++i) shape.push_back({i / 20.0, 0.2 + 1.2 * i / 20.0});
    ASSERT_TRUE(ProfileLibrary().save(QStringLiteral("Clothoid"), shape));
    ASSERT_NO_FATAL_FAILURE(test::WindowFixture::SetUp());
    window_->beginDrawing(NewDrawingDialog::recipeFor({200, 120}, 127.0));
    ASSERT_TRUE(waitUntil([this] { return session().isBlankPage() && !session().isBusy(); }));
    draw(150.0);
    draw(350.0);
    ASSERT_TRUE(settle());
    ASSERT_EQ(session().curves().size(), 2u);
    window_->setStage(PanelStage::Fairing);
  }
  void TearDown() override {
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)).removeRecursively();
    QCoreApplication::setApplicationName(before_);
  }

  static Vec2 placeOf(double top, double t) { return Vec2(100.0 + 700.0 * t, top + 40.0 * std::sin(2.2 * t)); }
  void draw(double top) {
    auto* canvas = find<CurveCanvas>("canvas");
    QTest::mousePress(canvas, Qt::LeftButton, {}, canvas->toWidget(placeOf(top, 0.0)).toPoint());
    for (int i = 1; i <= 60; ++i) {
      const QPointF at = canvas->toWidget(placeOf(top, i / 60.0));
      QMouseEvent move(QEvent::MouseMove, at, canvas->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
      QCoreApplication::sendEvent(canvas, &move);
    }
    QTest::mouseRelease(canvas, Qt::LeftButton, {}, canvas->toWidget(placeOf(top, 1.0)).toPoint());
    ASSERT_TRUE(settle());
  }
  ProfileShelf* shelf() { return find<ProfileShelf>("fairing.profiles"); }
  /// Drops what the shelf gives for its first entry. @return whether the drawing took it.
  bool drop(const Vec2& px) {
    if (shelf()->count() == 0) return false;
    QCoreApplication::processEvents();  // the drawing makes room for the panels of the stage
    auto* canvas = find<CurveCanvas>("canvas");
    const std::unique_ptr<QMimeData> data(shelf()->model()->mimeData({shelf()->model()->index(0, 0)}));
    const QPointF at = canvas->toWidget(px);
    QDragEnterEvent enter(at.toPoint(), Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(canvas, &enter);
    EXPECT_TRUE(enter.isAccepted());
    EXPECT_TRUE(find<QLabel>("status.hint")->text().contains(QStringLiteral("rofile")));
    QDropEvent dropped(at, Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
    dropped.ignore();
    QCoreApplication::sendEvent(canvas, &dropped);
    return dropped.isAccepted();
  }

 private:
  QString before_;
};

TEST_F(Shelf, ListsWhatWasSaved) {
  ASSERT_TRUE(shelf()->isVisible());
  ASSERT_EQ(shelf()->count(), 1);
  EXPECT_EQ(shelf()->item(0)->text(), QStringLiteral("Clothoid"));
}

TEST_F(Shelf, AProfileDroppedOnALineBecomesItsTarget) {
  session().selectCurve(0);
  const int lower =
      session().curves()[0].sketched.point(0.0).y() < session().curves()[1].sketched.point(0.0).y() ? 0 : 1;
  ASSERT_TRUE(drop(placeOf(350.0, 0.4)));
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().selectedCurve(), lower);
  const TracedCurve& line = session().curves()[lower];
  EXPECT_EQ(line.fairingUsed.mode, FairingMode::Target);
  EXPECT_EQ(line.fairingUsed.target, FairingTarget::Drawn);
  EXPECT_FALSE(line.fairingUsed.profile.empty());
  EXPECT_EQ(session().curves()[1 - lower].fairingUsed.mode, FairingMode::None);
  session().undoStack()->undo();
  ASSERT_TRUE(settle());
  EXPECT_EQ(session().curves()[lower].fairingUsed.mode, FairingMode::None);
}

TEST_F(Shelf, AProfileDroppedBesideTheLinesChangesNothing) {
  const Recipe before = session().recipe();
  EXPECT_FALSE(drop({500.0, 560.0}));
  EXPECT_EQ(session().recipe(), before);
}

TEST_F(Shelf, AProfileThatIsRemovedIsGoneFromShelfAndLibrary) {
  const auto answer = [](QMessageBox::StandardButton button) {
    QTimer::singleShot(100, [button] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      ASSERT_NE(box, nullptr);
      EXPECT_TRUE(box->text().contains(QStringLiteral("Clothoid"))) << box->text().toStdString();
      box->button(button)->click();
    });
  };
  auto* title = find<QLabel>("fairing.savedProfiles");
  EXPECT_TRUE(title->isVisible());
  shelf()->setCurrentRow(0);
  answer(QMessageBox::No);
  find<QAction>("fairing.removeProfile")->trigger();
  EXPECT_EQ(shelf()->count(), 1);
  answer(QMessageBox::Yes);
  find<QAction>("fairing.removeProfile")->trigger();
  EXPECT_TRUE(ProfileLibrary().names().isEmpty());
  EXPECT_FALSE(shelf()->isVisible());
  EXPECT_FALSE(title->isVisible());
}

}  // namespace
}  // namespace batten
