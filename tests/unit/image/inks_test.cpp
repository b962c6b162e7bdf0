// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/colour/inks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/image/colour/ink_picker.h"
#include "core/image/page_preparation.h"
#include "core/image/threshold/binarize.h"
#include "tests/support/colour_page.h"

namespace batten {
namespace {

using test::InkLayer;
using test::lineCoverage;

constexpr int kInkWidth = 480, kInkHeight = 360;
constexpr std::array<double, 3> kRedBallpoint{0.85, 0.25, 0.3}, kBlueRule{0.55, 0.65, 0.92},
    kBlackPen{0.12, 0.12, 0.12};

InkLayer stroke(const Vec2& a, const Vec2& b, double width, const std::array<double, 3>& passes) {
  return {lineCoverage(kInkWidth, kInkHeight, a, b, width), passes};
}

InkChoice dropping(const InkColour& ink) {
  InkChoice choice;
  choice.drop.push_back(ink);
  return choice;
}
InkChoice keeping(const InkColour& ink) {
  InkChoice choice;
  choice.keep.push_back(ink);
  return choice;
}

/// A red and a black stroke that cross two blue ones.
struct InkPage {
  InkLayer red = stroke({40, 60}, {440, 300}, 4, kRedBallpoint), black = stroke({60, 320}, {420, 40}, 4, kBlackPen),
           upper = stroke({20, 120}, {460, 120}, 5, kBlueRule), lower = stroke({20, 240}, {460, 240}, 5, kBlueRule);
  Scan scan;
  explicit InkPage(double noise = 2.0) {
    test::ColourPage page;
    page.width = kInkWidth;
    page.height = kInkHeight;
    page.paperLeft = {250, 244, 232};
    page.paperRight = {214, 206, 192};
    page.noise = noise;
    scan = test::renderColourPage(page, {upper, lower, red, black});
  }
  BitImage inkWith(const InkChoice& choice) const {
    PreparationParams params;
    params.inks = choice;
    const PreparedPage page = *preparePage(scan, params, {});
    const GreyImage& grey = page.grey ? *page.grey : scan.grey;
    return *binarize(grey, *findThresholds(grey, {}, {}, {}), {}, {});
  }
};

TEST(Inks, AreFoundByTheirHue) {
  const InkPage page;
  const auto inks = findInks(page.scan.grey, page.scan.colour, {});
  ASSERT_EQ(inks.size(), 3u);
  EXPECT_FALSE(inks[0].colour.hueDeg.has_value());
  EXPECT_NEAR(*inks[1].colour.hueDeg, 224.0, 8.0);
  EXPECT_TRUE(isSameInk(inks[2].colour, {355.0}, 8.0));
}

TEST(Inks, ArePickedWhereTheyLie) {
  const InkPage page;
  const InkPicker picker(page.scan.grey, page.scan.colour, {});
  const auto all = findInks(page.scan.grey, page.scan.colour, {});
  ASSERT_EQ(all.size(), 3u);
  constexpr double kReachPx = 8.0, kRangeDeg = 20.0;
  const auto picks = [&](const Vec2& px, const FoundInk& ink) {
    const auto found = picker.inkAt(px, kReachPx);
    return found && isSameInk(found->colour, ink.colour, kRangeDeg);
  };
  EXPECT_TRUE(picks({200, 245}, all[1])) << "beside a blue stroke";
  EXPECT_TRUE(picks({150, 245}, all[0])) << "between a blue and a black stroke, nearer to the black one";
  EXPECT_TRUE(picks({100, 97}, all[2])) << "on the red one";
  EXPECT_TRUE(picks({90, 298}, all[0])) << "on the black one";
  EXPECT_FALSE(picker.inkAt({440, 180}, kReachPx)) << "paper";
  EXPECT_FALSE(picker.inkAt({-500, 180}, kReachPx));
  EXPECT_FALSE(picker.inkAt({1e9, 1e9}, kReachPx));
  EXPECT_FALSE(picker.inkAt({std::nan(""), 3.0}, kReachPx));
  const GreyImage grey(40, 30);
  EXPECT_FALSE(InkPicker(grey, {}, {}).inkAt({20, 15}, kReachPx));
}

TEST(Inks, OfAGreyScanAreNone) {
  InkPage page;
  page.scan.colour = ColourImage();
  EXPECT_TRUE(findInks(page.scan.grey, page.scan.colour, {}).empty());
  EXPECT_FALSE(dropInks(page.scan.grey, page.scan.grey, page.scan.colour, dropping({0.0}), {}));
}

TEST(Inks, ADroppedInkGoesAndTheStrokesAcrossItStayWhole) {
  const InkPage page;
  const BitImage ink = page.inkWith(dropping({225.0}));
  EXPECT_GT(test::shareFound(page.red.coverage, ink), 0.97);
  EXPECT_GT(test::shareFound(page.black.coverage, ink), 0.99);
  EXPECT_LT(test::shareFound(page.upper.coverage, ink), 0.08);  // where the others cross
  EXPECT_LT(test::shareFound(page.lower.coverage, ink), 0.08);
}

TEST(Inks, OnlyTheKeptOnesAreTraced) {
  const InkPage page;
  const BitImage red = page.inkWith(keeping({0.0}));
  EXPECT_GT(test::shareFound(page.red.coverage, red), 0.95);
  EXPECT_LT(test::shareFound(page.black.coverage, red), 0.08);
  EXPECT_LT(test::shareFound(page.upper.coverage, red), 0.08);
  const BitImage black = page.inkWith(keeping({}));
  EXPECT_GT(test::shareFound(page.black.coverage, black), 0.98);
  EXPECT_LT(test::shareFound(page.red.coverage, black), 0.08);
}

TEST(Inks, HuesGoRoundAndAreChecked) {
  EXPECT_TRUE(isSameInk({350.0}, {10.0}, 20.0));
  EXPECT_FALSE(isSameInk({350.0}, {20.0}, 20.0));
  EXPECT_FALSE(isSameInk({350.0}, {}, 90.0));
  EXPECT_TRUE(isTraced({20.0}, keeping({0.0})));
  EXPECT_FALSE(isTraced({20.0}, dropping({0.0})));
  EXPECT_FALSE(validate(InkChoice{}).has_value());
  EXPECT_TRUE(validate(keeping({361.0})).has_value());
  InkChoice narrow;
  narrow.rangeDeg = 2.0;
  EXPECT_TRUE(validate(narrow).has_value());
}

}  // namespace
}  // namespace batten
