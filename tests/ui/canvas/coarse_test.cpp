// SPDX-License-Identifier: GPL-3.0-or-later
// Large pages: what the window shows until the full result is there.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "core/pipeline/run/coarse_run.h"
#include "tests/support/large_page.h"
#include "tests/ui/window_fixture.h"
#include "ui/canvas/layers/chip_layer.h"
#include "ui/canvas/layers/raster_layer.h"
#include "ui/session/background/inbox.h"
#include "ui/session/runs/coarse_runner.h"

namespace batten {
namespace {

using test::waitUntil;

std::shared_ptr<const Scan> tenMillionPixels() {
  static const auto kPage = std::make_shared<const Scan>(test::largePage(3800, 2700, 12, 3));
  return kPage;
}

/// So large that a coarse result comes first on a busy machine, too.
std::shared_ptr<const Scan> manyMillionPixels() {
  static const auto kPage = std::make_shared<const Scan>(test::largePage(6000, 4200, 12, 3));
  return kPage;
}

QImage imageOf(const Scan& scan) {
  QImage image(scan.grey.width, scan.grey.height, QImage::Format_Grayscale8);
  for (int y = 0; y < scan.grey.height; ++y)
    for (int x = 0; x < scan.grey.width; ++x) image.scanLine(y)[x] = static_cast<uchar>(scan.grey.row(y)[x] / 257);
  return image;
}

double shareAlike(const BitImage& full, const BitImage& coarse, int factor) {
  int alike = 0;
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x)
      alike += coarse.at(x, y) == full.at(x * factor + factor / 2, y * factor + factor / 2) ? 1 : 0;
  return alike / (1.0 * coarse.width * coarse.height);
}

TEST(CoarseRunner, FindsTheInkOfTheFullPage) {
  const auto page = tenMillionPixels();
  Inbox inbox;
  std::shared_ptr<const CoarseResult> ink, curves;
  CoarseRunner runner(inbox, [&](const auto& scan, auto result) {
    EXPECT_EQ(scan, page);
    (result->faired ? curves : ink) = result;
  });
  runner.start({page, Recipe{}, 7, true});
  ASSERT_TRUE(waitUntil([&] { return curves && !runner.isRunning(); }));
  ASSERT_TRUE(ink);
  EXPECT_EQ(ink->generation, 7u);
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Filtered;
  const PipelineOutput full = runPipeline(*page, {}, cache, request, {});
  EXPECT_GT(shareAlike(full.filtered->ink, ink->filtered->ink, ink->factor), 0.99);
  EXPECT_EQ(curves->faired->curves.size(), 12u);
  // A change of the threshold shows in the next one.
  Recipe darker;
  darker.threshold.mode = ThresholdMode::Manual;
  darker.threshold.manualLevel = 60.0;
  darker.paper.flatten = false;
  const auto before = ink->filtered->ink.count();
  ink = curves = nullptr;
  runner.start({page, darker, 8, false});
  ASSERT_TRUE(waitUntil([&] { return ink && !runner.isRunning(); }));
  EXPECT_LT(ink->filtered->ink.count(), before);
  EXPECT_FALSE(curves) << "the ink alone was asked for";
}

TEST(CoarseRunner, ASmallPageNeedsNone) {
  Inbox inbox;
  int shown = 0;
  CoarseRunner runner(inbox, [&](const auto&, auto) { ++shown; });
  runner.start({std::make_shared<const Scan>(test::largePage(600, 400, 2, 1)), Recipe{}, 1, true});
  EXPECT_FALSE(runner.isRunning());
  EXPECT_EQ(shown, 0);
}

TEST(RasterLayer, AMaskOfASmallerPageCoversTheWholePage) {
  auto coarse = std::make_shared<BitImage>(10, 10);
  for (int y = 0; y < 10; ++y)
    for (int x = 5; x < 10; ++x) coarse->set(x, y, true);
  RasterContent content;
  content.pageWidth = content.pageHeight = 40;
  content.mask = coarse;
  content.maskFactor = 4;
  const QImage out = renderRaster(content, 2.0, QRect(0, 0, 80, 80));
  EXPECT_GT(qRed(out.pixel(38, 70)), 200);
  EXPECT_LT(qRed(out.pixel(42, 70)), 60);
  EXPECT_LT(qRed(out.pixel(79, 2)), 60);
}

class LargePage : public test::WindowFixture {
 protected:
  /// Does something and stops all work once the coarse result is there that it leads to; false where the full one was
  /// faster.
  bool stopsAtCoarse(const std::function<bool()>& isThere, const std::function<void()>& act) {
    bool isStopped = false;
    const QObject here;
    QObject::connect(&session(), &EditorSession::coarseReady, &here, [&] {
      if (isStopped || !isThere()) return;
      isStopped = true;
      session().cancel();
    });
    act();
    EXPECT_TRUE(waitUntil([&] { return !session().isBusy() && !session().hasRunningJobs(); }));
    return isStopped;
  }
  void savePage(const Scan& page) {
    path_ = folder_.filePath(QStringLiteral("large.png"));
    ASSERT_TRUE(imageOf(page).save(path_));
  }
  /// Pixels of the canvas in which red, or blue, prevails.
  int colouredPixels() {
    const QImage shown = find<CurveCanvas>("canvas")->grab().toImage();
    int found = 0;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x) {
        const QColor color = shown.pixelColor(x, y);
        found += std::abs(color.blue() - color.red()) > 90 ? 1 : 0;
      }
    return found;
  }
};

TEST_F(LargePage, TheCoarseCurvesAreDrawnAndSaidToBeCoarse) {
  ASSERT_NO_FATAL_FAILURE(savePage(*manyMillionPixels()));
  constexpr int kTries = 8;  // on a busy machine it is chance which one comes first
  for (int i = 0; i < kTries && !session().coarseCurves(); ++i)
    stopsAtCoarse([this] { return session().coarseCurves() != nullptr; }, [this] { window_->openPath(path_); });
  ASSERT_TRUE(session().coarseCurves());
  window_->setStage(PanelStage::Scan);
  const int without = colouredPixels();
  window_->setStage(PanelStage::Edges);
  EXPECT_TRUE(waitUntil([&] { return colouredPixels() > without + 500; }, 5000)) << colouredPixels();
  const CanvasScene scene(session(), window_->view());
  EXPECT_TRUE(workText(scene).contains(QStringLiteral("coarse result"))) << workText(scene).toStdString();
}

TEST_F(LargePage, TheCoarseInkIsShownBeforeTheFullOneIsThere) {
  ASSERT_NO_FATAL_FAILURE(savePage(*manyMillionPixels()));
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  ASSERT_TRUE(waitUntil([this] { return !session().isWorking() && !session().hasRunningJobs(); }));
  const auto brightness = [this] {
    const QImage shown = find<CurveCanvas>("canvas")->grab().toImage();
    double sum = 0.0;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x) sum += qGray(shown.pixel(x, y));
    return sum / (1.0 * shown.width() * shown.height());
  };
  window_->setStage(PanelStage::CleanUp);
  Recipe usual = session().recipe();
  Recipe dark = usual;
  dark.threshold.mode = ThresholdMode::Manual;
  dark.threshold.manualLevel = 254.0;  // the paper is ink
  dark.paper.flatten = false;
  double before = 0.0;
  bool isStopped = false;
  constexpr int kTries = 8;  // on a busy machine it is chance which one comes first
  for (int i = 0; i < kTries && !isStopped; ++i) {
    session().change(QStringLiteral("Threshold"), dark);
    ASSERT_TRUE(waitUntil([this] { return !session().isWorking() && !session().hasRunningJobs(); }));
    ASSERT_TRUE(waitUntil(
        [&] {
          const double last = std::exchange(before, brightness());
          return before == last;
        },
        5000));
    usual.threshold.strength += 0.01;  // so that nothing of it is known
    isStopped = stopsAtCoarse([this] { return session().coarseInk() != nullptr; },
                              [&] { session().change(QStringLiteral("Threshold"), usual); });
  }
  ASSERT_TRUE(isStopped);
  EXPECT_TRUE(waitUntil([&] { return brightness() - before > 30.0; }, 5000)) << brightness() << ", " << before;
}

// Of two large pages at once there may be no room for one.
TEST_F(LargePage, APageGoesWhenAnotherIsOpened) {
  ASSERT_NO_FATAL_FAILURE(openPage(test::zigzagPage()));
  const std::weak_ptr<const Scan> first = session().scan();
  const QString other = folder_.filePath(QStringLiteral("other.png"));
  ASSERT_TRUE(test::ellipsePage().save(other));
  ASSERT_NO_FATAL_FAILURE(openFile(other));
  EXPECT_TRUE(waitUntil([&] { return first.expired(); }, 5000)) << first.use_count();
}

TEST_F(LargePage, TheCoarseResultComesFirstAndGoesWhenTheFullOneIsThere) {
  ASSERT_NO_FATAL_FAILURE(savePage(*tenMillionPixels()));
  QSignalSpy coarse(&session(), &EditorSession::coarseReady);
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  EXPECT_FALSE(session().coarseInk());
  EXPECT_FALSE(session().coarseCurves());
  EXPECT_EQ(session().curves().size(), 12u);

  // A full run that waits for nothing else; the coarse one is done in between. On a busy machine it is chance which one
  // comes first.
  constexpr int kTries = 8;
  Recipe recipe = session().recipe();
  recipe.threshold.mode = ThresholdMode::Manual;
  bool wasSeen = false;
  for (int i = 0; i < kTries && !wasSeen; ++i) {
    const int before = coarse.count();
    recipe.threshold.manualLevel = 140.0 + i;
    session().change(QStringLiteral("Threshold"), recipe);
    ASSERT_TRUE(waitUntil([&] {
      wasSeen = wasSeen || session().coarseInk();
      return !session().isBusy() && !session().hasRunningJobs();
    }));
    wasSeen = wasSeen || coarse.count() > before;
  }
  EXPECT_TRUE(wasSeen);
  EXPECT_FALSE(session().coarseInk());
  EXPECT_FALSE(session().isStale(StageId::Faired));

  // What changes no ink asks for no coarse one.
  const int asked = coarse.count();
  recipe.fairing.toleranceMm = 0.31;
  session().change(QStringLiteral("Tolerance"), recipe);
  ASSERT_TRUE(waitUntil([&] { return !session().isBusy() && !session().hasRunningJobs(); }));
  EXPECT_EQ(coarse.count(), asked);
}

}  // namespace
}  // namespace batten
