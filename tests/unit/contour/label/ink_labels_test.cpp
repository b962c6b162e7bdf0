// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/ink_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/image/bits/bit_steps.h"
#include "tests/support/label_page.h"

namespace batten {
namespace {

InkLabels labelsOf(const BitImage& ink) {
  const auto labels = labelInk(ink, {});
  EXPECT_TRUE(labels);
  return labels ? *labels : InkLabels{};
}

double shareOfShapes(const InkLabels& labels) {
  const double shapes = static_cast<double>(labels.shapes.count());
  return shapes / (shapes + static_cast<double>(labels.strokes.count()));
}

std::vector<Vec2> segment(const Vec2& a, const Vec2& b) { return {a, b}; }

TEST(InkLabels, EveryPixelOfInkHasOneLabel) {
  const BitImage ink = test::labelScenes()[0].make(3).ink(3);
  const InkLabels labels = labelsOf(ink);
  EXPECT_EQ(both(labels.strokes, labels.shapes).count(), 0);
  EXPECT_EQ(either(labels.strokes, labels.shapes), ink);
  EXPECT_EQ(without(labels.skeleton, ink).count(), 0);
}

TEST(InkLabels, ASolidAndTheLineAttachedToItAreTwoLabelsOfOnePiece) {
  test::LabelPage page(400, 300);
  page.begin(true);
  page.area({test::circle({120, 150}, 50)});
  page.begin(false);
  page.line(segment({140, 150}, {380, 150}), 4.0);
  const BitImage ink = page.ink(1);
  const InkLabels labels = labelsOf(ink);
  const auto score = page.score(ink, labels.shapes);
  EXPECT_GT(score.shapes, 0.98);
  EXPECT_GT(score.strokes, 0.97);
  // The line begins where it leaves the solid.
  EXPECT_TRUE(labels.shapes.at(166, 150));
  EXPECT_TRUE(labels.strokes.at(175, 150));
}

TEST(InkLabels, CrossingsOfTwoWidthsAreStrokes) {
  test::LabelPage page(400, 400);
  page.begin(false);
  page.line(segment({20, 60}, {380, 330}), 9.0);
  page.line(segment({30, 350}, {370, 40}), 3.0);
  page.line(segment({200, 20}, {210, 380}), 3.0);
  EXPECT_LT(shareOfShapes(labelsOf(page.ink(2))), 0.001);
}

// A bar is as even as a stroke, but no pen is so wide.
TEST(InkLabels, BarsWiderThanAnyPenAreShapes) {
  for (const double width : {12.0, 40.0}) {
    test::LabelPage page(400, 400);
    page.begin(true);
    page.line(segment({60, 40}, {60, 360}), width);
    page.line(segment({60, 200}, {300, 60}), width);
    page.line(segment({60, 200}, {300, 340}), width);
    const double shapes = shareOfShapes(labelsOf(page.ink(2)));
    EXPECT_EQ(shapes, width > 20.0 ? 1.0 : 0.0) << width;
  }
}

/// Fine lines, and broad ones joined to them: as many px of these, beside 2 960 px of those.
double shareOfShapesAmongFineLines(double broadPx) {
  test::LabelPage page(800, 600);
  page.begin(false);
  page.line({{40, 40}, {760, 40}, {760, 560}, {40, 560}, {40, 40}}, 3.0);
  page.line(segment({40, 300}, {760, 300}), 3.0);
  for (double y = 100.0; broadPx > 0.0; y += 60.0, broadPx -= 300.0) {
    page.line(segment({40, y}, {250, y}), 3.0);
    page.line(segment({250, y}, {550, y}), 20.0);
  }
  return shareOfShapes(labelsOf(page.ink(2)));
}

// A filled ribbon is as even as a stroke, but a second pen would have drawn more.
TEST(InkLabels, AFilledRibbonAmongFineLinesIsAShape) {
  EXPECT_NEAR(shareOfShapesAmongFineLines(300.0), 6000.0 / (6000.0 + 3.0 * (2960.0 + 240.0)), 0.05);
  EXPECT_LT(shareOfShapesAmongFineLines(1500.0), 0.01);
}

TEST(InkLabels, ATaperedStrokeIsAStroke) {
  test::LabelPage page(400, 200);
  page.begin(false);
  page.line(segment({20, 100}, {380, 110}), 1.6, 8.0);
  EXPECT_LT(shareOfShapes(labelsOf(page.ink(3))), 0.001);
}

// Brush strokes that thin out at both ends are as uneven as letters of a broad nib, but they are no alphabet.
TEST(InkLabels, AGroupOfTaperedStrokesIsOfStrokes) {
  for (const double width : {5.0, 8.0}) {
    test::LabelPage page(1000, 700);
    page.begin(false);
    for (int i = 0; i < 12; ++i) {
      const auto at = [&](double widths) { return Vec2(60.0 + 75.0 * i + widths, 40.0 + widths * width); };
      page.line(segment(at(0), at(8)), 1.0, width);
      page.line(segment(at(8), at(16)), width);
      page.line(segment(at(16), at(24)), width, 1.0);
    }
    EXPECT_LT(shareOfShapes(labelsOf(page.ink(6))), 0.001) << width;
  }
}

TEST(InkLabels, DotsBesideLinesAreShapes) {
  test::LabelPage page(400, 200);
  page.begin(false);
  page.line(segment({20, 60}, {380, 60}), 4.0);
  for (int i = 0; i < 5; ++i) {
    page.begin(true);
    page.area({test::circle({60.0 + 60.0 * i, 140}, 4.0)});
  }
  const BitImage ink = page.ink(4);
  const auto score = page.score(ink, labelsOf(ink).shapes);
  EXPECT_EQ(score.objects, 1.0);
}

// A felt pen among the lines of a fine pen: where its line bends and swells, and a fine line meets it, it goes on.
TEST(InkLabels, ALineThatSwellsIsAStroke) {
  test::LabelPage page(600, 400);
  page.begin(false);
  for (int i = 0; i < 8; ++i) page.line(segment({20, 240.0 + 20.0 * i}, {580, 250.0 + 18.0 * i}), 3.0);
  page.line(segment({20, 200}, {280, 110}), 12.0);
  page.line(segment({280, 110}, {310, 100}), 12.0, 17.0);
  page.line(segment({310, 100}, {340, 90}), 17.0, 12.0);
  page.line(segment({340, 90}, {580, 20}), 12.0);
  page.line(segment({306, 106}, {560, 200}), 3.0);
  page.line(segment({306, 106}, {340, 210}), 3.0);
  EXPECT_LT(shareOfShapes(labelsOf(page.ink(3))), 0.001);
}

// A step in width on all sides: a filled shape, whatever lines run into it.
TEST(InkLabels, ABlackThatLinesRunIntoIsAShape) {
  test::LabelPage page(600, 400);
  page.begin(false);
  for (int i = 0; i < 8; ++i) page.line(segment({20, 240.0 + 20.0 * i}, {580, 250.0 + 18.0 * i}), 3.0);
  page.line(segment({20, 140}, {580, 100}), 12.0);
  page.begin(true);
  page.area({{{270, 100}, {330, 96}, {334, 146}, {274, 150}}});
  const BitImage ink = page.ink(3);
  EXPECT_GT(page.score(ink, labelsOf(ink).shapes).shapes, 0.9);
}

/// Of the marks that `draw` makes among lines of a pen, the share that is labelled shape.
double shareOfShapesOf(const std::function<void(test::LabelPage&)>& draw, double penPx) {
  test::LabelPage page(800, 600);
  page.begin(false);
  for (int i = 0; i < 8; ++i) page.line(segment({20, 340.0 + 30.0 * i}, {780, 350.0 + 28.0 * i}), penPx);
  page.begin(true);
  draw(page);
  const BitImage ink = page.ink(3);
  return page.score(ink, labelsOf(ink).shapes).shapes;
}

// One even stroke runs through it from end to end, but its bars and its bowl are no part of that.
TEST(InkLabels, AMonogramThatOneStrokeDoesNotRedrawIsAShape) {
  const auto monogram = [](test::LabelPage& page) {
    page.line({{200, 40}, {204, 130}, {240, 190}, {262, 260}}, 18.0);
    page.line(segment({178, 78}, {226, 76}), 18.0);
    page.area({test::circle({276, 280}, 46), test::circle({278, 280}, 5)});
    page.line(segment({196, 172}, {226, 168}), 30.0);
  };
  EXPECT_GT(shareOfShapesOf(monogram, 3.0), 0.99);
}

TEST(InkLabels, AFilledLetterAmongFineLinesIsAShape) {
  const auto letter = [](test::LabelPage& page) {
    page.line(segment({200, 60}, {198, 160}), 20.0);
    page.line(segment({260, 60}, {262, 160}), 20.0);
    page.line(segment({200, 112}, {260, 110}), 17.0);
  };
  EXPECT_GT(shareOfShapesOf(letter, 3.0), 0.99);
}

// The outline of a car with its tyres filled in: a line of a broad pen, whatever is joined to it.
TEST(InkLabels, ALongLineOfABroadPenStaysAStroke) {
  test::LabelPage page(1200, 600);
  page.begin(false);
  for (int i = 0; i < 12; ++i) page.line(segment({20, 330.0 + 20.0 * i}, {1180, 340.0 + 19.0 * i}), 3.0);
  page.line({{60, 240}, {160, 150}, {420, 120}, {560, 40}, {860, 44}, {1020, 130}, {1130, 160}, {1140, 250}}, 12.0);
  page.begin(true);
  page.area({test::circle({120, 250}, 62)});
  page.area({test::circle({1080, 250}, 62)});
  const BitImage ink = page.ink(3);
  const auto score = page.score(ink, labelsOf(ink).shapes);
  EXPECT_GT(score.strokes, 0.95);
  EXPECT_GT(score.shapes, 0.9);
}

// A bird, as it stands for a network: no wider than two and a half pens along most of it, and no stroke.
TEST(InkLabels, AStubbyMarkOfUnevenWidthIsAShape) {
  const auto mark = [](test::LabelPage& page) {
    page.line({{200, 120}, {222, 124}}, 8.0, 20.0);
    page.line({{222, 124}, {248, 112}}, 20.0, 7.0);
    page.line({{216, 122}, {214, 92}}, 14.0, 4.0);
  };
  EXPECT_GT(shareOfShapesOf(mark, 5.3), 0.99);
}

// Letters filled in by hand, thick and thin whatever their direction: no pen draws so.
TEST(InkLabels, LettersThatWereFilledInAreShapes) {
  test::LabelPage page(1200, 500);
  for (int i = 0; i < 16; ++i) {
    page.begin(true);
    const double x = 50.0 + 140.0 * (i % 8), y = 60.0 + 220.0 * (i / 8);
    const bool isUpright = i % 2 == 0;
    page.line(segment({x, y}, {x, y + 150}), isUpright ? 17.0 : 7.0);
    page.line(segment({x, y + 150}, {x + 80, y + 146}), isUpright ? 7.0 : 17.0);
    page.line(segment({x + 4, y + 4}, {x + 70, y + 60}), isUpright ? 7.0 : 12.0);
  }
  EXPECT_GT(shareOfShapes(labelsOf(page.ink(3))), 0.99);
}

// As large and as broad as dashes beside it, but where lines of their pen crossed the ink would be no wider.
TEST(InkLabels, ABlotAmongDashesIsAShape) {
  test::LabelPage page(800, 600);
  page.begin(false);
  for (int i = 0; i < 8; ++i) page.line(segment({20, 340.0 + 30.0 * i}, {780, 350.0 + 28.0 * i}), 5.3);
  for (int i = 0; i < 8; ++i) page.line(segment({300.0 + 50.0 * i, 150}, {310.0 + 50.0 * i, 210}), 11.0);
  page.begin(true);
  page.line(segment({200, 160}, {222, 160}), 17.0);
  const BitImage ink = page.ink(3);
  EXPECT_GT(page.score(ink, labelsOf(ink).shapes).shapes, 0.95);
}

// Legs of even width, but nothing on the page says that a pen of that width was used.
TEST(InkLabels, TheLimbsOfASilhouetteBelongToIt) {
  test::LabelPage page(500, 400);
  page.begin(true);
  page.area({test::circle({250, 130}, 100)});
  for (const double x : {180.0, 220.0, 280.0, 320.0}) page.line(segment({x, 180}, {x, 370}), 24.0, 18.0);
  EXPECT_GT(shareOfShapes(labelsOf(page.ink(5))), 0.999);
}

TEST(InkLabels, AnAlphabetGetsOneTreatment) {
  for (const test::LabelScene& scene : test::labelScenes()) {
    if (scene.name != "mono M" && scene.name != "nib M" && scene.name != "nib L" && scene.name != "mono L") continue;
    const test::LabelPage page = scene.make(21);
    const BitImage ink = page.ink(21);
    EXPECT_GT(page.score(ink, labelsOf(ink).shapes).balanced(), 0.97) << scene.name;
  }
}

// Letters of a marker whose line swells and thins out as it runs, whatever its direction: handwriting, and no nib.
// @param size of the letters, in those of 60 px.
test::LabelPage unevenHandwriting(double size, double leastPx, double mostPx) {
  test::LabelPage page(900, 500);
  page.begin(false);
  for (int i = 0; i < 27; ++i) {
    const Vec2 origin(50.0 + 95.0 * (i % 9), 40.0 + 150.0 * (i / 9));
    const auto placed = [&](double x, double y) { return Vec2(origin + size * Vec2(x, y)); };
    const std::vector<Vec2> letter = {placed(0, 0), placed(12, 60), placed(40, 60), placed(46, 25), placed(14, 24)};
    page.line(segment(placed(26, 60), placed(30, 90)), 0.5 * (leastPx + mostPx));
    int swing = i;
    for (std::size_t k = 1; k < letter.size(); ++k) {
      for (double from = 0.0; from < 1.0; from += 0.5) {
        const auto at = [&](double f) { return Vec2(letter[k - 1] + f * (letter[k] - letter[k - 1])); };
        const bool isSwelling = ++swing % 2 == 0;
        page.line(segment(at(from), at(from + 0.5)), isSwelling ? leastPx : mostPx, isSwelling ? mostPx : leastPx);
      }
    }
  }
  return page;
}

TEST(InkLabels, UnevenHandwritingIsStrokes) {
  EXPECT_LT(shareOfShapes(labelsOf(unevenHandwriting(1.0, 4.5, 10.5).ink(4))), 0.01);
}

// Of letters about five pens high.
TEST(InkLabels, SmallUnevenHandwritingIsStrokes) {
  EXPECT_LT(shareOfShapes(labelsOf(unevenHandwriting(0.5, 3.0, 9.0).ink(4))), 0.01);
}

// Letters of a felt pen above words of a fine pen, of about their size; where lines of a word meet, a disc fits in that
// is nearly as large as in the letters.
TEST(InkLabels, WordsOfAFinePenAreNotLettersOfAFeltPen) {
  test::LabelPage page(900, 500);
  for (int i = 0; i < 18; ++i) {
    const double x = 60.0 + 95.0 * (i % 9), y = 40.0 + 100.0 * (i / 9);
    page.begin(true);
    page.line({{x, y}, {x + 12, y + 60}}, 15.0);
    page.line({{x + 12, y + 60}, {x + 40, y + 40}}, 15.0);
  }
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < 5; ++i) {
      const double x = 50.0 + 170.0 * i, y = 280.0 + 110.0 * row;
      page.begin(false);
      page.line({{x, y}, {x + 20, y - 50}, {x + 30, y}, {x + 60, y - 40}, {x + 75, y}, {x + 110, y - 10}}, 5.0);
      page.line({{x + 60, y - 40}, {x + 65, y - 25}, {x + 75, y}}, 5.0);
      page.line({{x + 60, y - 40}, {x + 63, y - 20}, {x + 75, y}}, 5.0);
    }
  }
  const BitImage ink = page.ink(4);
  const auto score = page.score(ink, labelsOf(ink).shapes);
  EXPECT_GT(score.strokes, 0.95);
  EXPECT_GT(score.shapes, 0.95);
}

TEST(InkLabels, MixedPagesAreToldApart) {
  for (const test::LabelScene& scene : test::labelScenes()) {
    if (scene.name != "mixed" && scene.name != "solid" && scene.name != "cross" && scene.name != "taper") continue;
    const test::LabelPage page = scene.make(31);
    const BitImage ink = page.ink(31);
    EXPECT_GT(page.score(ink, labelsOf(ink).shapes).balanced(), 0.95) << scene.name;
  }
}

TEST(InkLabels, APageTurnedByAQuarterHasTheSameShapes) {
  const BitImage ink = test::labelScenes()[1].make(7).ink(7);
  BitImage turned(ink.height, ink.width);
  for (int y = 0; y < ink.height; ++y) {
    for (int x = 0; x < ink.width; ++x) {
      if (ink.at(x, y)) turned.set(ink.height - 1 - y, x, true);
    }
  }
  EXPECT_NEAR(shareOfShapes(labelsOf(turned)), shareOfShapes(labelsOf(ink)), 0.01);
}

TEST(InkLabels, NothingAndAllInkAreNoTrouble) {
  EXPECT_EQ(labelsOf(BitImage(70, 50)).shapes.count(), 0);
  BitImage full(70, 50);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 70; ++x) full.set(x, y, true);
  }
  EXPECT_EQ(labelsOf(full).shapes.count(), 70 * 50);
  BitImage dot(70, 50);
  dot.set(30, 30, true);
  EXPECT_EQ(labelsOf(dot).shapes.count(), 1);
}

TEST(InkLabels, ACancelledRunSaysSo) {
  RunContext context;
  context.cancel.cancel();
  const auto labels = labelInk(test::labelScenes()[0].make(1).ink(1), context);
  ASSERT_FALSE(labels);
  EXPECT_EQ(labels.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
