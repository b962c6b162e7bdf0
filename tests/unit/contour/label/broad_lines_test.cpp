// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/broad_lines.h"

#include <gtest/gtest.h>

#include "core/contour/centreline/skeleton/skeleton.h"
#include "tests/support/label_page.h"

namespace batten {
namespace {

constexpr double kPen = 4.0, kBar = 24.0, kWidestPen = 60.0;

/// Of the pixels of the graph that lie from `x0` to `x1` and in ink as broad as the bar, those that are shapes.
double shareOfShapes(const InkGraph& graph, double x0, double x1) {
  double shapes = 0.0, all = 0.0;
  for (const InkChain& chain : graph.chains()) {
    for (const InkPixel& p : chain.pixels) {
      if (p.x < x0 || p.x >= x1 || p.widthPx() < 0.7 * kBar) continue;
      all += 1.0;
      shapes += p.label == InkLabel::Shape ? 1.0 : 0.0;
    }
  }
  return all > 0.0 ? shapes / all : -1.0;
}

struct Labelled {
  InkGraph graph;
  BitImage shapes;
};

/// A bar along y = 200 with fine lines into it; left of `x` it is taken for a shape.
Labelled bar(double x, double widthLeft) {
  test::LabelPage page(700, 400);
  page.begin(false);
  page.line({{40, 200}, {x, 200}}, widthLeft);
  page.line({{x, 200}, {660, 200}}, kBar);
  for (double at = 80.0; at < 640.0; at += 90.0) page.line({{at, 40}, {at, 200}}, kPen);
  const BitImage ink = page.ink(1);
  BitImage skeleton = ink;
  EXPECT_TRUE(thinToSkeleton(skeleton, {}));
  Labelled labelled{InkGraph(skeleton, ink, {}), ink};
  for (int row = 0; row < ink.height; ++row)
    for (int column = static_cast<int>(x); column < ink.width; ++column) labelled.shapes.set(column, row, false);
  const auto label = [&](InkPixel& p) { p.label = labelled.shapes.at(p.x, p.y) ? InkLabel::Shape : InkLabel::Stroke; };
  for (InkChain& chain : labelled.graph.chains())
    for (InkPixel& p : chain.pixels) label(p);
  for (InkNode& node : labelled.graph.nodes())
    for (InkPixel& p : node.pixels) label(p);
  return labelled;
}

TEST(BroadLines, ABarThatIsMostlyStrokeIsAllOfIt) {
  Labelled labelled = bar(240, kBar);
  EXPECT_GT(shareOfShapes(labelled.graph, 60, 230), 0.9);
  EXPECT_TRUE(releaseBroadLines(labelled.graph, kPen, kWidestPen, labelled.shapes));
  EXPECT_EQ(shareOfShapes(labelled.graph, 60, 640), 0.0);
}

TEST(BroadLines, ABarThatIsMostlyShapeIsLeft) {
  Labelled labelled = bar(460, kBar);
  EXPECT_FALSE(releaseBroadLines(labelled.graph, kPen, kWidestPen, labelled.shapes));
  EXPECT_GT(shareOfShapes(labelled.graph, 60, 450), 0.9);
}

TEST(BroadLines, ASolidThatABarRunsIntoIsAShape) {
  Labelled labelled = bar(180, 2.0 * kBar);
  EXPECT_FALSE(releaseBroadLines(labelled.graph, kPen, kWidestPen, labelled.shapes));
  EXPECT_GT(shareOfShapes(labelled.graph, 60, 170), 0.9);
}

TEST(BroadLines, NoPenDrewWhatIsWiderThanAnyPen) {
  Labelled labelled = bar(240, kBar);
  EXPECT_FALSE(releaseBroadLines(labelled.graph, kPen, 0.5 * kBar, labelled.shapes));
}

// Lines of the page's own pen are not looked at.
TEST(BroadLines, LinesOfThePenAreNotBroad) {
  Labelled labelled = bar(240, kBar);
  EXPECT_FALSE(releaseBroadLines(labelled.graph, kBar, kWidestPen, labelled.shapes));
}

}  // namespace
}  // namespace batten
