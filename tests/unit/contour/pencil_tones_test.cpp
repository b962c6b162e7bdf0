// SPDX-License-Identifier: GPL-3.0-or-later
// A box shaded with a pencil: the lines on its tones, between them and around them are lines, and the tones are none.

#include "core/image/tones/pencil_tones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/image/page_preparation.h"
#include "core/image/tones/without_tones.h"
#include "tests/support/dense_page.h"
#include "tests/support/render_page.h"
#include "tests/support/stress_page.h"
#include "tests/support/tones_on.h"
#include "tests/unit/contour/traced_page.h"

namespace batten {
namespace {

constexpr auto tonesOn = test::tonesOn<findPencilTones>;

constexpr int kBoxWidth = 800, kBoxHeight = 600;
constexpr double kBoxLinePx = 4.0;
constexpr std::uint32_t kBoxSeeds[] = {1, 2, 3};

std::vector<Vec2> edgeOfBox(const Vec2& from, const Vec2& to) {
  std::vector<Vec2> line;
  const int n = static_cast<int>((to - from).norm());
  for (int i = 0; i <= n; ++i) line.push_back(from + (to - from) * (static_cast<double>(i) / n));
  return line;
}

const Vec2 kBoxA(150.0, 150.0), kBoxB(400.0, 200.0), kBoxC(400.0, 480.0), kBoxD(150.0, 420.0), kBoxE(620.0, 140.0),
    kBoxF(620.0, 400.0);

/// The edges of two faces and a line across each.
std::vector<std::vector<Vec2>> firmLines() {
  return {edgeOfBox(kBoxA, kBoxB),
          edgeOfBox(kBoxB, kBoxC),
          edgeOfBox(kBoxC, kBoxD),
          edgeOfBox(kBoxD, kBoxA),
          edgeOfBox(kBoxB, kBoxE),
          edgeOfBox(kBoxE, kBoxF),
          edgeOfBox(kBoxF, kBoxC),
          edgeOfBox({440.0, 320.0}, {585.0, 250.0}),
          edgeOfBox({190.0, 220.0}, {360.0, 380.0})};
}
/// On paper: the lines that the box was constructed with.
std::vector<std::vector<Vec2>> lightLines() {
  return {edgeOfBox({60.0, 540.0}, {740.0, 560.0}), edgeOfBox({60.0, 60.0}, {560.0, 90.0}),
          edgeOfBox({680.0, 60.0}, {700.0, 500.0}), edgeOfBox({90.0, 100.0}, {80.0, 500.0})};
}

/// What is drawn on the page beside the box: 0..1 of a pencil.
using Cover = std::vector<float>;

/// @param side, front 0..1 of the pencil on the faces; that of the front grows along it. @param light 0..1 of that of
/// the light lines. @param tooth 0..1 how far the paper's grain tears it.
GreyImage boxPage(double side, double front, double light, double tooth, std::uint32_t seed, const Cover& beside = {}) {
  std::vector<float> cover = test::fillCoverage({kBoxB, kBoxE, kBoxF, kBoxC}, kBoxWidth, kBoxHeight);
  const std::vector<float> onFront = test::fillCoverage({kBoxA, kBoxB, kBoxC, kBoxD}, kBoxWidth, kBoxHeight);
  const std::vector<float> firm = test::coverageOf(firmLines(), kBoxLinePx, kBoxWidth, kBoxHeight);
  const std::vector<float> faint = test::coverageOf(lightLines(), kBoxLinePx, kBoxWidth, kBoxHeight);
  for (std::size_t i = 0; i < cover.size(); ++i) {
    const double x = static_cast<double>(i % kBoxWidth);
    const double graded = front * std::clamp((x - kBoxA.x()) / (kBoxB.x() - kBoxA.x()), 0.0, 1.0);
    const double tone = side * static_cast<double>(cover[i]) + graded * static_cast<double>(onFront[i]);
    const double line = std::max(0.9 * static_cast<double>(firm[i]), light * static_cast<double>(faint[i]));
    cover[i] = static_cast<float>(1.0 - (1.0 - tone) * (1.0 - line));
    if (!beside.empty()) cover[i] = std::max(cover[i], beside[i]);
  }
  test::grainCoverage(
      cover, kBoxWidth, kBoxHeight, [=](double, double) { return tooth; }, seed);
  return test::scanOfLines(std::move(cover), kBoxWidth, kBoxHeight, seed).grey;
}

test::LineScore boxScore(const GreyImage& page) {
  std::vector<std::vector<Vec2>> found;
  for (const Contour& c : tracedPage(page).contours) {
    std::vector<Vec2>& line = found.emplace_back();
    for (const ContourPoint& p : c.points) line.push_back(p.at);
  }
  std::vector<std::vector<Vec2>> drawn = firmLines();
  for (auto& line : lightLines()) drawn.push_back(std::move(line));
  return test::scoreLines(drawn, found, kBoxWidth, kBoxHeight);
}

/// Pencil lines, shaded.
GreyImage shadedBox(std::uint32_t seed) { return boxPage(0.5, 0.4, 0.28, 0.8, seed); }

TEST(PencilTones, LinesOnThemAreFoundAndTheirBordersAreNone) {
  for (const std::uint32_t seed : kBoxSeeds) {
    const GreyImage page = shadedBox(seed);
    const std::optional<ToneAreas> tones = tonesOn(page, {});
    ASSERT_TRUE(tones) << "seed " << seed;
    const test::LineScore before = boxScore(page), after = boxScore(withoutTones(page, *tones, {}));
    EXPECT_GT(before.falsePx, 1500.0) << "seed " << seed << ": borders of the tones";
    EXPECT_LT(after.falsePx, 200.0) << "seed " << seed;
    EXPECT_GT(after.covered, 0.98) << "seed " << seed;
    EXPECT_LT(after.rmsPx, 0.5) << "seed " << seed;
  }
}

// What the default recipe does with such a page.
TEST(PencilTones, AreLeftOutOfThePageUnlessKept) {
  Scan scan;
  scan.grey = shadedBox(4);
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page && page->grey);
  EXPECT_NEAR(page->shadedShare, 0.2, 0.06);
  EXPECT_EQ(page->grey->row(30)[30], scan.grey.row(30)[30]) << "paper is untouched";
  EXPECT_EQ(page->grey->row(300)[85], scan.grey.row(300)[85]) << "lines elsewhere are untouched";
  PreparationParams kept;
  kept.shading = ShadingUse::Keep;
  EXPECT_FALSE(preparePage(scan, kept, {})->grey);
}

// A pen has one darkness. What it fills and hatches stays ink.
TEST(PencilTones, InkOfOneDarknessHasNone) {
  std::vector<std::vector<Vec2>> lines = firmLines();
  for (auto& line : test::hatchLines({500.0, 300.0}, 30.0, 20, 10.0, 180.0, 0.0)) lines.push_back(std::move(line));
  std::vector<float> cover = test::coverageOf(lines, kBoxLinePx, kBoxWidth, kBoxHeight);
  const std::vector<float> solid = test::fillCoverage({kBoxA, kBoxB, kBoxC, kBoxD}, kBoxWidth, kBoxHeight);
  std::vector<float> filled = cover;
  for (std::size_t i = 0; i < filled.size(); ++i) filled[i] = std::max(filled[i], solid[i]);
  EXPECT_FALSE(tonesOn(test::scanOfLines(cover, kBoxWidth, kBoxHeight, 1).grey, {})) << "hatched";
  EXPECT_FALSE(tonesOn(test::scanOfLines(filled, kBoxWidth, kBoxHeight, 1).grey, {})) << "filled";
}

// Shows no paper inside, but has many darknesses: the paper is darker from left to right and is not seen below it.
TEST(PencilTones, AFaintSilhouetteOnDarkPaperHasNone) {
  constexpr int kWidth = 2480, kHeight = 3508;
  const std::vector<float> cover =
      test::fillCoverage(test::truthShape("crown", kWidth, kHeight).outline(), kWidth, kHeight);
  EXPECT_FALSE(tonesOn(test::renderPage(cover, kWidth, kHeight, test::darkPage(1)).grey, {}));
}

// Without a shaded face; shaded so faintly that no threshold takes it for ink.
TEST(PencilTones, PencilLinesAloneHaveNone) {
  EXPECT_FALSE(tonesOn(boxPage(0.0, 0.0, 0.28, 0.8, 1), {}));
  EXPECT_FALSE(tonesOn(boxPage(0.12, 0.05, 0.28, 0.8, 1), {})) << "faint";
}

// A face as dark as the lines around it was filled.
TEST(PencilTones, ASolidBesideThemStays) {
  const GreyImage page = boxPage(0.97, 0.8, 0.28, 0.1, 1);
  const std::optional<ToneAreas> tones = tonesOn(page, {});
  ASSERT_TRUE(tones);
  const GreyImage without = withoutTones(page, *tones, {});
  for (int x = 480; x < 600; x += 10) EXPECT_EQ(without.row(300)[x], page.row(300)[x]) << "at " << x;
}

constexpr double kGrilleLeft = 470.0, kGrilleTop = 480.0, kGrilleRight = 650.0, kGrilleBottom = 535.0;
constexpr double kHatchPx = 14.0;  // from stroke to stroke along the border

/// A rectangle that strokes to and fro both ways fill, with paper between them. @param base 0..1 of what they smudged.
Cover grille(double base) {
  std::vector<std::vector<Vec2>> strokes;
  const double height = kGrilleBottom - kGrilleTop;
  for (double x = kGrilleLeft; x + height <= kGrilleRight; x += kHatchPx) {
    strokes.push_back(edgeOfBox({x, kGrilleTop}, {x + height, kGrilleBottom}));
    strokes.push_back(edgeOfBox({x + height, kGrilleTop}, {x, kGrilleBottom}));
  }
  Cover cover = test::coverageOf(strokes, kBoxLinePx, kBoxWidth, kBoxHeight);
  const Cover inside = test::fillCoverage({{kGrilleLeft, kGrilleTop},
                                           {kGrilleRight, kGrilleTop},
                                           {kGrilleRight, kGrilleBottom},
                                           {kGrilleLeft, kGrilleBottom}},
                                          kBoxWidth, kBoxHeight);
  for (std::size_t i = 0; i < cover.size(); ++i)
    cover[i] = inside[i] * static_cast<float>(base + (0.95 - base) * static_cast<double>(cover[i]));
  return cover;
}

/// Closed outlines that leave out less of the grille at its sides than lies between two strokes.
int outlinesOfGrille(const GreyImage& page) {
  int found = 0;
  for (const Contour& c : tracedPage(page).contours) {
    if (c.kind != ContourKind::Outline || !c.closed || c.hole) continue;
    Vec2 low = c.points.front().at, high = low;
    for (const ContourPoint& p : c.points) low = low.cwiseMin(p.at), high = high.cwiseMax(p.at);
    const double off = std::max((low - Vec2(kGrilleLeft, kGrilleTop)).cwiseAbs().maxCoeff(),
                                (high - Vec2(kGrilleRight, kGrilleBottom)).cwiseAbs().maxCoeff());
    found += off < kHatchPx ? 1 : 0;
  }
  return found;
}

// Hatching as dark as lines that ends sharply all around is a shape; faint or fading hatching is a tone.
TEST(PencilTones, WhatHatchingFillsIsOneShape) {
  for (const std::uint32_t seed : kBoxSeeds) {
    const GreyImage page = boxPage(0.5, 0.4, 0.28, 0.5, seed, grille(0.45));
    const std::optional<ToneAreas> tones = tonesOn(page, {});
    ASSERT_TRUE(tones) << "seed " << seed;
    EXPECT_EQ(outlinesOfGrille(withoutTones(page, *tones, {})), 1) << "seed " << seed;
    ASSERT_TRUE(tones->filled) << "seed " << seed;
    const std::optional<ToneAreas> ofFaint = tonesOn(boxPage(0.5, 0.4, 0.28, 0.5, seed, grille(0.15)), {});
    EXPECT_TRUE(!ofFaint || !ofFaint->filled) << "seed " << seed << ": mostly paper";
    EXPECT_FALSE(tonesOn(shadedBox(seed), {})->filled) << "seed " << seed << ": shaded";
  }
}

/// A rectangle that upright bars fill, with faint gaps between them. @param gapPx between two bars
Cover bars(double gapPx) {
  constexpr double kPitchPx = 20.0;
  Cover cover(std::ptrdiff_t{kBoxWidth} * kBoxHeight, 0.0f);
  for (int y = static_cast<int>(kGrilleTop); y < static_cast<int>(kGrilleBottom); ++y)
    for (int x = static_cast<int>(kGrilleLeft); x < static_cast<int>(kGrilleRight); ++x)
      cover[std::ptrdiff_t{y} * kBoxWidth + x] = std::fmod(x - kGrilleLeft, kPitchPx) < gapPx ? 0.1f : 0.95f;
  return cover;
}

// A car, drawn with lines close together and dark tones between them, is as dark as a filled area in the mean.
TEST(PencilTones, WhatShowsLinesAndWhatIsBetweenIsNotFilled) {
  for (const std::uint32_t seed : kBoxSeeds) {
    const auto narrow = tonesOn(boxPage(0.5, 0.4, 0.28, 0.5, seed, bars(2.0)), {});
    ASSERT_TRUE(narrow) << "seed " << seed;
    EXPECT_TRUE(narrow->filled) << "seed " << seed;
    const auto wide = tonesOn(boxPage(0.5, 0.4, 0.28, 0.5, seed, bars(7.0)), {});
    ASSERT_TRUE(wide) << "seed " << seed;
    EXPECT_FALSE(wide->filled) << "seed " << seed;
  }
}

// Printed beside a drawing: what is black all over and ends within a pixel is not torn, and its border stays in place.
TEST(PencilTones, ACrispSolidBesideThemIsNotFilledAgain) {
  for (const std::uint32_t seed : kBoxSeeds) {
    GreyImage page = shadedBox(seed);
    constexpr auto kBlack = static_cast<std::uint16_t>(10 * GreyImage::kGreyUnit);
    for (int y = static_cast<int>(kGrilleTop); y < static_cast<int>(kGrilleBottom); ++y)
      std::fill(page.row(y) + static_cast<int>(kGrilleLeft), page.row(y) + static_cast<int>(kGrilleRight), kBlack);
    const std::optional<ToneAreas> tones = tonesOn(page, {});
    ASSERT_TRUE(tones) << "seed " << seed;
    EXPECT_FALSE(tones->filled) << "seed " << seed;
    const GreyImage without = withoutTones(page, *tones, {});
    for (int x = 500; x < 620; x += 10)
      for (const int outside : {2, 4, 6})
        EXPECT_GT(without.level(x, static_cast<int>(kGrilleTop) - outside), 150.0) << "seed " << seed << " at " << x;
  }
}

TEST(PencilTones, AreTheSameWithAnyNumberOfThreadsAndNotLookedForAfterACancel) {
  const GreyImage page = shadedBox(5);
  RunContext one, eight;
  one.threads = 1;
  eight.threads = 8;
  const auto a = tonesOn(page, one), b = tonesOn(page, eight);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(withoutTones(page, *a, one), withoutTones(page, *b, eight));
  RunContext stopped;
  stopped.cancel.cancel();
  EXPECT_FALSE(tonesOn(page, stopped));
}

}  // namespace
}  // namespace batten
