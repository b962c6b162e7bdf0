// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/painted_ink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contour/ink/ink_split.h"
#include "core/contour/trace_contours.h"
#include "core/image/bits/bit_steps.h"
#include "tests/support/label_page.h"

namespace batten {
namespace {

constexpr int kPaintWidth = 500, kPaintHeight = 300;

/// A stroke across the page at y = 80, and a solid disc at (250, 200).
struct PaintPage {
  BitImage ink;
  GreyImage grey;
  PaintPage() {
    test::LabelPage page(kPaintWidth, kPaintHeight);
    page.begin(false);
    page.line({{40, 80}, {460, 80}}, 6.0);
    page.begin(true);
    page.area({test::circle({250, 200}, 50)});
    ink = page.ink(1);
    grey = page.grey(1);
  }
  Result<ContourSet> trace(const EdgeParams& edges) const { return traceContours(ink, grey, edges, {}, {}); }
};

std::ptrdiff_t countOf(const ContourSet& set, ContourKind kind) {
  return std::ranges::count(set.contours, kind, &Contour::kind);
}

// The pixels whose centres lie within the radius of the course, told one by one.
TEST(PaintedInk, IsAllInkWithinTheRadiusOfTheCourse) {
  BitImage all(130, 90);
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x) all.set(x, y, (x * 7 + y * 3) % 5 != 0);
  const std::vector<PaintedInk> courses = {
      {{Vec2(20, 20)}, 7.3, EdgeMode::Outline},
      {{Vec2(-30, 40), Vec2(60, 41.5), Vec2(60, 80), Vec2(60, 80)}, 5.0, EdgeMode::Outline},
      {{Vec2(100, -50), Vec2(90, 200)}, 0.5, EdgeMode::Outline},
      {{Vec2(125, 85), Vec2(300, 300)}, 11.0, EdgeMode::Outline},
      {{Vec2(1e6, -1e6), Vec2(-1e6, 1e6)}, 3.0, EdgeMode::Outline}};
  for (const PaintedInk& one : courses) {
    BitImage strokes = all, shapes(all.width, all.height);
    const BitImage painted = applyPaint(std::span(&one, 1), strokes, shapes, {});
    for (int y = 0; y < all.height; ++y) {
      for (int x = 0; x < all.width; ++x) {
        const bool isInside = all.at(x, y) && isUnder(one, {x + 0.5, y + 0.5});
        ASSERT_EQ(shapes.at(x, y), isInside) << x << ", " << y;
        ASSERT_EQ(painted.at(x, y), isInside);
      }
    }
    EXPECT_EQ(either(strokes, shapes), all);
    EXPECT_EQ(both(strokes, shapes).count(), 0);
  }
}

TEST(PaintedInk, TheLastCountsAndThePageCanHaveItsInkBack) {
  const PaintPage page;
  const auto split = [&](std::vector<PaintedInk> painted) {
    EdgeParams edges;
    edges.painted = std::move(painted);
    return *splitInk(page.ink, page.grey, edges, {});
  };
  const InkSplit before = split({});
  ASSERT_TRUE(before.strokes.at(250, 80) && before.shapes.at(250, 200));
  EXPECT_FALSE(before.painted);
  const PaintedInk shape{{Vec2(200, 80), Vec2(300, 80)}, 10.0, EdgeMode::Outline};
  const InkSplit one = split({shape});
  EXPECT_TRUE(one.shapes.at(250, 80));
  EXPECT_TRUE(one.strokes.at(150, 80) && one.strokes.at(350, 80)) << "only what was painted";
  EXPECT_TRUE(one.shapes.at(250, 200));
  PaintedInk stroke = shape;
  stroke.mode = EdgeMode::Centreline;
  const InkSplit back = split({shape, stroke});
  EXPECT_EQ(back.strokes, before.strokes);
  PaintedInk page1 = shape;
  page1.mode = EdgeMode::Automatic;
  const InkSplit own = split({shape, page1});
  EXPECT_EQ(own.strokes, before.strokes);
  EXPECT_EQ(own.shapes, before.shapes);
  ASSERT_TRUE(own.painted);
  EXPECT_EQ(own.painted->count(), 0);
}

TEST(PaintedInk, APartOfAStrokeIsTracedByItsOutline) {
  const PaintPage page;
  const auto before = page.trace({});
  ASSERT_TRUE(before);
  EXPECT_EQ(countOf(*before, ContourKind::Centreline), 1);
  EXPECT_EQ(countOf(*before, ContourKind::Outline), 1);
  EdgeParams edges;
  edges.painted = {{{Vec2(200, 80), Vec2(300, 80)}, 10.0, EdgeMode::Outline}};
  const auto after = page.trace(edges);
  ASSERT_TRUE(after);
  EXPECT_EQ(countOf(*after, ContourKind::Centreline), 2) << "what is left at both sides";
  EXPECT_EQ(countOf(*after, ContourKind::Outline), 2);
  // It follows the ink, also where a threshold has made that thinner.
  PaintPage thin;
  thin.ink = shrunken(thin.ink, 1, {});
  const auto thinner = thin.trace(edges);
  ASSERT_TRUE(thinner);
  EXPECT_EQ(countOf(*thinner, ContourKind::Outline), 2);
  EXPECT_EQ(countOf(*thinner, ContourKind::Centreline), 2);
}

TEST(PaintedInk, AClickOnPaintedInkTurnsItOverAlone) {
  const PaintPage page;
  EdgeParams edges;
  edges.painted = {{{Vec2(200, 80), Vec2(300, 80)}, 10.0, EdgeMode::Outline}};
  edges.choices = {{Vec2(250, 80), EdgeMode::Centreline}};
  const InkSplit split = *splitInk(page.ink, page.grey, edges, {});
  EXPECT_TRUE(split.strokes.at(250, 80));
  // And one beside it leaves what was painted.
  edges.choices = {{Vec2(100, 80), EdgeMode::Outline}};
  edges.painted[0].mode = EdgeMode::Centreline;
  const InkSplit beside = *splitInk(page.ink, page.grey, edges, {});
  EXPECT_TRUE(beside.shapes.at(100, 80));
  EXPECT_TRUE(beside.strokes.at(250, 80));
}

TEST(PaintedInk, WhatHasNoMiddleIsTracedByItsOutlineWithANote) {
  const PaintPage page;
  EdgeParams edges;
  edges.painted = {{{Vec2(250, 200)}, 80.0, EdgeMode::Centreline}};
  const auto set = page.trace(edges);
  ASSERT_TRUE(set);
  EXPECT_EQ(countOf(*set, ContourKind::Outline), 1);
  EXPECT_NE(set->report.note.find("painted"), std::string::npos) << set->report.note;
}

TEST(PaintedInk, IsChecked) {
  const PaintedInk good{{Vec2(1, 2)}, 4.0, EdgeMode::Outline};
  EXPECT_FALSE(validate(good));
  PaintedInk bad = good;
  bad.coursePx.clear();
  EXPECT_TRUE(validate(bad));
  bad = good;
  bad.coursePx.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0.0);
  EXPECT_TRUE(validate(bad));
  for (const double radius : {0.0, -3.0, 1e4, std::numeric_limits<double>::infinity(), std::nan("")}) {
    bad = good;
    bad.radiusPx = radius;
    EXPECT_TRUE(validate(bad)) << radius;
  }
  EXPECT_EQ(scaledRadius(good, 0.01), 0.5);
  EXPECT_EQ(scaledRadius(good, 2.0), 8.0);
}

}  // namespace
}  // namespace batten
