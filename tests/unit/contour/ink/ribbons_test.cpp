// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/ribbons.h"

#include <gtest/gtest.h>

#include "core/image/bits/bit_steps.h"

namespace batten {
namespace {

// A ribbon from the left to the right of the page, rows [40, 80), and what lines leave out of it.
constexpr int kRibbonPage = 600, kRibbonTop = 40, kRibbonBottom = 80;

BitImage bar(int x0, int y0, int x1, int y1) {
  BitImage image(kRibbonPage, 120);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) image.set(x, y, true);
  }
  return image;
}

ContourSet lineBeside(int y, float widthPx) {
  ContourSet set;
  Contour& line = set.contours.emplace_back();
  line.kind = ContourKind::Centreline;
  for (int x = 0; x < kRibbonPage; ++x) {
    ContourPoint& p = line.points.emplace_back();
    p.at = p.unrefined = Vec2(x + 0.5, y);
    p.widthPx = widthPx;
  }
  return set;
}

TEST(Ribbons, AFillingIsMostOfItsRibbon) {
  const BitImage ribbon = bar(20, kRibbonTop, 580, kRibbonBottom), none(kRibbonPage, 120);
  const ContourSet line = lineBeside(44, 8.0f);
  const BitImage pill = bar(280, 58, 330, 72), filling = bar(20, 52, 580, kRibbonBottom);
  EXPECT_EQ(fillingsOfRibbons(pill, ribbon, none, line, {}).count(), 0);
  EXPECT_EQ(fillingsOfRibbons(filling, ribbon, none, line, {}), filling);
  EXPECT_EQ(fillingsOfRibbons(pill, ribbon, bar(330, 0, 340, 20), line, {}).count(), 0) << "a shape elsewhere";
  EXPECT_EQ(fillingsOfRibbons(pill, ribbon, bar(330, 50, 400, 70), line, {}), pill) << "a shape goes on in it";
}

TEST(Ribbons, PillsOfOneRibbonCountTogether) {
  const BitImage ribbon = bar(20, kRibbonTop, 580, kRibbonBottom), none(kRibbonPage, 120);
  BitImage pills(kRibbonPage, 120);
  for (int x = 20; x < 560; x += 60) pills = either(pills, bar(x, 48, x + 50, 78));
  EXPECT_EQ(fillingsOfRibbons(pills, ribbon, none, lineBeside(42, 8.0f), {}), pills);
}

// Two fifths of the ribbon, 16 px wide: two lines of 5 px hold no such disc, two of 8 px do.
TEST(Ribbons, ASolidIsWiderThanTheLinesBesideIt) {
  const BitImage ribbon = bar(20, kRibbonTop, 580, kRibbonBottom), none(kRibbonPage, 120);
  const BitImage filling = bar(20, 50, 580, 66);
  EXPECT_EQ(fillingsOfRibbons(filling, ribbon, none, lineBeside(47, 5.0f), {}), filling);
  EXPECT_EQ(fillingsOfRibbons(filling, ribbon, none, lineBeside(46, 8.0f), {}).count(), 0);
  EXPECT_EQ(fillingsOfRibbons(bar(20, 50, 140, 66), ribbon, none, lineBeside(47, 5.0f), {}).count(), 0)
      << "less than a quarter of the ribbon around";
}

// The same pill where the ribbon ends, and on the thin line that goes on from there.
TEST(Ribbons, WhatIsNarrowerIsAnotherThing) {
  const BitImage none(kRibbonPage, 120);
  const BitImage ink = either(bar(20, 55, 580, 65), bar(200, kRibbonTop, 300, kRibbonBottom));
  const BitImage knob = bar(205, 50, 295, kRibbonBottom);
  EXPECT_EQ(fillingsOfRibbons(knob, ink, none, lineBeside(45, 8.0f), {}), knob);
}

}  // namespace
}  // namespace batten
