// SPDX-License-Identifier: GPL-3.0-or-later
// What the window offers does what it says.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QLineEdit>
#include <QTest>
#include <string>

#include "tests/ui/window_fixture.h"
#include "ui/panels/controls/panel_parts.h"
#include "ui/panels/stages/fairing_figures.h"
#include "ui/session/curves/curve_names.h"
#include "ui/session/runs/tolerance_offer.h"

namespace batten {
namespace {

using test::waitUntil;

class Promise : public test::WindowFixture {
 protected:
  void pressTarget(int degree) {
    auto* canvas = find<CurveCanvas>("canvas");
    canvas->setFocus();
    QTest::keyClick(canvas, static_cast<Qt::Key>(Qt::Key_0 + degree));
    ASSERT_TRUE(settleTargets());
  }
  bool settleTargets() {
    return settle() && waitUntil([this] { return !session().isTargeting(); });
  }
  /// Takes the offer where there is one, and expects of it what it says.
  void takeOffer(const std::string& where) {
    auto* raise = find<QAbstractButton>("fairing.raise");
    if (!fairingNote(*session().selected()).neededMm) return;
    const auto* offer = window_->findChild<ToleranceOffer*>();
    ASSERT_TRUE(waitUntil([offer] { return !offer->isTrying(); }));
    if (!raise->isVisible()) return;
    ++offers_;
    const QString text = raise->text();
    QTest::mouseClick(raise, Qt::LeftButton);
    ASSERT_TRUE(settleTargets());
    const TracedCurve& curve = *session().selected();
    EXPECT_TRUE(curve.fairing.withinTolerance) << where << ": " << text.toStdString() << ", " << curve.fairing.note;
    EXPECT_FALSE(fairingNote(curve).neededMm) << where;
    EXPECT_FALSE(raise->isVisible()) << where;
    const QString set = find<QLineEdit>("fairing.tolerance.field")->text();
    EXPECT_EQ(text.section(QLatin1Char(' '), 1, 1).toDouble(), set.toDouble())
        << where << ": " << text.toStdString() << " became " << set.toStdString();
  }
  int offers_ = 0;
};

TEST_F(Promise, TheToleranceThatATargetNeedsIsEnough) {
  ASSERT_NO_FATAL_FAILURE(openFile(QStringLiteral(BATTEN_SAMPLE)));
  window_->setStage(PanelStage::Fairing);
  QTest::mouseClick(find<QAbstractButton>("fairing.mode.target"), Qt::LeftButton);
  ASSERT_TRUE(settleTargets());
  const int begin = session().undoStack()->index();
  for (int number = 6; number <= 8; ++number) {
    const auto curve = curveOfNumber(session(), number);
    if (!curve) continue;
    for (int degree = 1; degree <= 6; ++degree) {
      for (const bool isDrawn : {false, true}) {
        session().selectCurve(*curve);
        ASSERT_NO_FATAL_FAILURE(pressTarget(degree));
        if (isDrawn) QTest::mouseClick(find<QAbstractButton>("fairing.draw"), Qt::LeftButton);
        ASSERT_TRUE(settleTargets());
        ASSERT_NO_FATAL_FAILURE(takeOffer("curve " + std::to_string(number) + ", target " + std::to_string(degree) +
                                          (isDrawn ? ", drawn" : "")));
        session().undoStack()->setIndex(begin);
        ASSERT_TRUE(settleTargets());
      }
    }
  }
  EXPECT_GE(offers_, 4);
}

TEST_F(Promise, TheTileOfTheTargetThatIsFollowedSaysWhatTheTableSays) {
  ASSERT_NO_FATAL_FAILURE(openFile(QStringLiteral(BATTEN_SAMPLE)));
  window_->setStage(PanelStage::Fairing);
  QTest::mouseClick(find<QAbstractButton>("fairing.mode.target"), Qt::LeftButton);
  for (const int number : {7, 8}) {
    const auto curve = curveOfNumber(session(), number);
    ASSERT_TRUE(curve);
    session().selectCurve(*curve);
    for (const int degree : {4, 6}) {
      ASSERT_NO_FATAL_FAILURE(pressTarget(degree));
      const FairingReport& report = session().selected()->fairing;
      ASSERT_EQ(report.targetDegree, degree);
      const QString tip = find<QAbstractButton>(("target." + std::to_string(degree)).c_str())->toolTip();
      EXPECT_TRUE(tip.contains(QStringLiteral("at most ") + millimetres(report.maxDeviationMm)))
          << tip.toStdString() << " beside " << report.maxDeviationMm;
    }
  }
}

}  // namespace
}  // namespace batten
