// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/texture_holes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/vec2.h"
#include "tests/support/brush_ink.h"
#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

struct Hole {
  Vec2 at;
  double radiusPx;
};

struct BrushPage {
  GreyImage grey;
  BitImage ink;
};

// A ring of 60 px with an inner radius of 60 px, and round holes in its ink.
BrushPage ring(const std::vector<Hole>& holes, double mottle) {
  test::RenderSettings s;
  s.width = s.height = 300;
  s.blurPx = 0.8;
  s.noise = 2.0;
  const auto inside = [&](double x, double y) {
    const double r = std::hypot(x - 150, y - 150);
    if (r < 60.0 || r > 120.0) return false;
    for (const Hole& h : holes) {
      if (std::hypot(x - h.at.x(), y - h.at.y()) < h.radiusPx) return false;
    }
    return true;
  };
  BrushPage page{test::renderShape(inside, s), {}};
  page.ink = test::thresholdMask(page.grey, 135.0);
  test::dryInk(page.grey, page.ink, mottle);
  return page;
}

std::vector<Hole> smallHoles(int count, double radiusPx) {
  std::vector<Hole> holes;
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * std::numbers::pi * i / count;
    holes.push_back({{150.0 + 90.0 * std::cos(a), 150.0 + 90.0 * std::sin(a)}, radiusPx});
  }
  return holes;
}

TEST(TextureHoles, HolesOfADryBrushAreFilledAndTheCounterStays) {
  const BrushPage page = ring(smallHoles(12, 2.5), 40.0);
  const EvenInk even = fillTextureHoles(page.ink, page.grey, {});
  EXPECT_EQ(even.filled, 12);
  EXPECT_TRUE(even.ink.at(240, 150));
  EXPECT_FALSE(even.ink.at(150, 150));
}

TEST(TextureHoles, SmallHolesInEvenInkAreDrawn) {
  const BrushPage page = ring(smallHoles(12, 2.5), 0.0);
  const EvenInk even = fillTextureHoles(page.ink, page.grey, {});
  EXPECT_EQ(even.filled, 0);
  EXPECT_EQ(even.ink, page.ink);
}

TEST(TextureHoles, AHoleWideAgainstItsStrokeIsDrawnInAnyInk) {
  std::vector<Hole> holes = smallHoles(12, 2.5);
  holes[0].radiusPx = 12.0;
  const BrushPage page = ring(holes, 40.0);
  const EvenInk even = fillTextureHoles(page.ink, page.grey, {});
  EXPECT_EQ(even.filled, 11);
  EXPECT_FALSE(even.ink.at(240, 150));
}

TEST(TextureHoles, FewHolesAreNoTexture) {
  const BrushPage page = ring(smallHoles(3, 2.5), 40.0);
  EXPECT_EQ(fillTextureHoles(page.ink, page.grey, {}).filled, 0);
}

TEST(TextureHoles, PagesWithoutHolesStayAsTheyAre) {
  BitImage ink(70, 40);
  for (int x = 10; x < 30; ++x) ink.set(x, 20, true);
  const GreyImage grey(70, 40);
  EXPECT_EQ(fillTextureHoles(ink, grey, {}).ink, ink);
  EXPECT_EQ(fillTextureHoles(BitImage(70, 40), grey, {}).ink.count(), 0);
  EXPECT_EQ(fillTextureHoles(BitImage(), GreyImage(), {}).filled, 0);
}

TEST(TextureHoles, CancelIsObeyed) {
  const BrushPage page = ring(smallHoles(12, 2.5), 40.0);
  RunContext context;
  context.cancel.cancel();
  EXPECT_EQ(fillTextureHoles(page.ink, page.grey, context).filled, 0);
}

}  // namespace
}  // namespace batten
