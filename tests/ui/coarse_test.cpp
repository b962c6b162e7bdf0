// SPDX-License-Identifier: GPL-3.0-or-later
// Large pages: what the window shows until the full result is there.
#include <gtest/gtest.h>

#include "core/pipeline/run/coarse_run.h"
#include "tests/support/large_page.h"
#include "tests/ui/window_fixture.h"
#include "ui/canvas/layers/raster_layer.h"
#include "ui/session/coarse_runner.h"
#include "ui/session/inbox.h"

namespace batten {
namespace {

using test::waitUntil;

std::shared_ptr<const Scan> tenMillionPixels() {
  static const auto kPage = std::make_shared<const Scan>(test::largePage(3800, 2700, 12, 3));
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

class LargePage : public test::WindowFixture {};

TEST_F(LargePage, TheCoarseResultComesFirstAndGoesWhenTheFullOneIsThere) {
  path_ = folder_.filePath(QStringLiteral("large.png"));
  ASSERT_TRUE(imageOf(*tenMillionPixels()).save(path_));
  QSignalSpy coarse(&session(), &EditorSession::coarseReady);
  ASSERT_NO_FATAL_FAILURE(openFile(path_));
  EXPECT_FALSE(session().coarseInk());
  EXPECT_FALSE(session().coarseCurves());
  EXPECT_EQ(session().curves().size(), 12u);

  // A full run that waits for nothing else; the coarse one is done in between.
  const int before = coarse.count();
  Recipe recipe = session().recipe();
  recipe.threshold.mode = ThresholdMode::Manual;
  recipe.threshold.manualLevel = 140.0;
  session().change(QStringLiteral("Threshold"), recipe);
  bool wasSeen = false;
  ASSERT_TRUE(waitUntil([&] {
    wasSeen = wasSeen || session().coarseInk();
    return !session().isBusy() && !session().hasRunningJobs();
  }));
  EXPECT_GT(coarse.count() + (wasSeen ? 1 : 0), before);
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
