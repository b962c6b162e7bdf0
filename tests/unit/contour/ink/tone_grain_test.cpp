// SPDX-License-Identifier: GPL-3.0-or-later
// Short lines on the grain of a tone, against a page on which every line that was drawn is known.

#include "core/contour/ink/tone_grain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contour/trace_contours.h"
#include "core/image/threshold/binarize.h"
#include "core/image/threshold/region_thresholds.h"
#include "tests/support/dense_page.h"

namespace batten {
namespace {

constexpr int kToneWidth = 1000, kToneHeight = 800;
constexpr double kToneX0 = 80.0, kToneX1 = 620.0, kToneY0 = 250.0, kToneY1 = 740.0;  // [px] the shaded area
constexpr float kToneCover = 0.26f;                                                  // of its ink
constexpr double kTonePencilPx = 4.0;
constexpr double kToneRimPx = 8.0 * kTonePencilPx;  // along its border the ground is not the tone alone
constexpr std::uint32_t kToneSeeds[] = {2, 3, 5};

bool isOnTone(const Vec2& p, double inside = 0.0) {
  return p.x() > kToneX0 + inside && p.x() < kToneX1 - inside && p.y() > kToneY0 + inside && p.y() < kToneY1 - inside;
}

std::vector<Vec2> between(const Vec2& from, const Vec2& to) {
  std::vector<Vec2> line;
  const int n = static_cast<int>((to - from).norm());
  for (int i = 0; i <= n; ++i) line.push_back(from + (to - from) * (static_cast<double>(i) / n));
  return line;
}

// Drawn as dark as ink: long lines above the tone, and short ones on it and beside it: hatching, dashes, letters.
std::vector<std::vector<Vec2>> drawnLines() {
  std::vector<std::vector<Vec2>> lines;
  for (int k = 0; k < 5; ++k) lines.push_back(between({60.0, 40.0 + 35.0 * k}, {940.0, 60.0 + 35.0 * k}));
  for (int k = 0; k < 8; ++k) lines.push_back(between({150.0 + 16.0 * k, 320.0}, {130.0 + 16.0 * k, 365.0}));
  for (int k = 0; k < 6; ++k) lines.push_back(between({350.0 + 40.0 * k, 340.0}, {374.0 + 40.0 * k, 340.0}));
  for (int k = 0; k < 6; ++k) {  // letters L and V
    const double x = 680.0 + 45.0 * k;
    lines.push_back(between({x, 400.0}, {x, 430.0}));
    lines.push_back(between({x, 430.0}, {x + 18.0, 430.0}));
    lines.push_back(between({x, 500.0}, {x + 10.0, 530.0}));
    lines.push_back(between({x + 10.0, 530.0}, {x + 20.0, 500.0}));
  }
  return lines;
}

GreyImage tonedPage(std::uint32_t seed) {
  std::vector<float> tone(std::size_t{kToneWidth} * kToneHeight, 0.0f);
  for (int y = 0; y < kToneHeight; ++y)
    for (int x = 0; x < kToneWidth; ++x)
      if (isOnTone({x, y})) tone[y * kToneWidth + x] = kToneCover;
  test::grainCoverage(
      tone, kToneWidth, kToneHeight, [](double, double) { return 1.0; }, seed);
  const std::vector<float> lines = test::coverageOf(drawnLines(), kTonePencilPx, kToneWidth, kToneHeight);
  for (std::size_t i = 0; i < tone.size(); ++i) tone[i] = std::max(tone[i], lines[i]);
  return test::scanOfLines(std::move(tone), kToneWidth, kToneHeight, seed).grey;
}

double toDrawn(const Vec2& p) {
  static const std::vector<std::vector<Vec2>> kLines = drawnLines();
  double least = 1e9;
  for (const auto& line : kLines)
    for (const Vec2& q : line) least = std::min(least, (p - q).norm());
  return least;
}

// [px] Of the lines that were drawn, and of those that were not.
struct Lengths {
  double drawn = 0.0, other = 0.0;
};

Lengths lengthsOn(const GreyImage& grey, const ContourParams& params) {
  Lengths lengths;
  const auto thresholds = findThresholds(grey, {}, {}, {});
  if (!thresholds) return lengths;
  const auto ink = binarize(grey, *thresholds, {}, {});
  if (!ink) return lengths;
  const auto set = traceContours(*ink, grey, {}, params, {});
  if (!set) return lengths;
  for (const Contour& c : set->contours) {
    if (c.kind != ContourKind::Centreline) continue;
    for (const ContourPoint& p : c.points) {
      if (toDrawn(p.at) < kTonePencilPx)
        lengths.drawn += 1.0;
      else if (isOnTone(p.at, kToneRimPx))
        lengths.other += 1.0;
    }
  }
  return lengths;
}

TEST(ToneGrain, IsDroppedAndWhatWasDrawnOnItStays) {
  // With limits of his own the user gets all lines.
  ContourParams own;
  own.minWidths += 0.01;
  for (const std::uint32_t seed : kToneSeeds) {
    const GreyImage grey = tonedPage(seed);
    const Lengths with = lengthsOn(grey, {}), without = lengthsOn(grey, own);
    EXPECT_GT(without.other, 300.0) << "seed " << seed;
    EXPECT_LT(with.other, 0.2 * without.other) << "seed " << seed;
    EXPECT_GT(with.drawn, 0.995 * without.drawn) << "seed " << seed;
  }
}

// A set of lines on noise [grey] of single pixels, each line as dark as is said.
struct FaintLine {
  std::vector<Vec2> course;
  double depth;  // [grey]
};

std::vector<bool> grainOf(const std::vector<FaintLine>& lines, double noise, double paper = 150.0,
                          bool isPencil = true) {
  GreyImage grey(600, 400);
  std::uint32_t state = 7;
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      double sum = 0.0;  // nearly normal, of unit variance
      for (int k = 0; k < 12; ++k)
        sum += static_cast<double>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0;
      grey.row(y)[x] = static_cast<std::uint16_t>(257.0 * std::clamp(paper + noise * (sum - 6.0), 0.0, 255.0));
    }
  }
  ContourSet set;
  for (const FaintLine& line : lines) {
    Contour c;
    c.kind = ContourKind::Centreline;
    c.points = contourPoints(line.course, true);
    for (ContourPoint& p : c.points) {
      p.widthPx = 4.0f;
      for (int dy = -2; dy < 2; ++dy)
        for (int dx = -2; dx < 2; ++dx) {
          std::uint16_t& pixel = grey.row(static_cast<int>(p.at.y()) + dy)[static_cast<int>(p.at.x()) + dx];
          pixel = std::min(pixel, static_cast<std::uint16_t>(257.0 * (paper - line.depth)));
        }
    }
    measureContour(c);
    set.contours.push_back(std::move(c));
  }
  return linesOfGrain(set, grey, isPencil, {});
}

TEST(ToneGrain, AFaintDashIsGrainOnNoiseAloneAndNotInCompany) {
  const FaintLine longLine{between({50.0, 50.0}, {550.0, 60.0}), 120.0};
  const FaintLine dash{between({300.0, 250.0}, {318.0, 258.0}), 25.0};
  EXPECT_FALSE(grainOf({longLine, dash}, 1.0)[1]) << "on clean paper";
  EXPECT_TRUE(grainOf({longLine, dash}, 50.0)[1]) << "alone in the noise";
  FaintLine dark = dash;
  dark.depth = 110.0;
  EXPECT_FALSE(grainOf({longLine, dark}, 50.0)[1]) << "as dark as a line";
  std::vector<FaintLine> hatching{longLine};
  for (int k = 0; k < 6; ++k) {
    const Vec2 off(-4.0 * k, 10.0 * k);
    hatching.push_back({between(Vec2(300.0, 200.0) + off, Vec2(318.0, 208.0) + off), 25.0});
  }
  const std::vector<bool> isGrain = grainOf(hatching, 50.0);
  EXPECT_EQ(std::count(isGrain.begin(), isGrain.end(), true), 0) << "hatching";
  EXPECT_FALSE(grainOf({longLine, {between({300.0, 250.0}, {352.0, 275.0}), 25.0}}, 50.0)[1]) << "long and straight";
}

// Of many lines of grain one stands out as far as none of a few does.
TEST(ToneGrain, OfAPageFullOfItTheDarkestGoToo) {
  const FaintLine longLine{between({50.0, 30.0}, {550.0, 40.0}), 120.0};
  const auto pageWith = [&](int count, double depth) -> bool {
    std::vector<FaintLine> lines{longLine, {between({300.0, 250.0}, {318.0, 258.0}), depth}};
    // In all directions, so that they are no company.
    for (int k = 0; k < count; ++k) {
      const Vec2 at(60.0 + 48.0 * (k % 10), 80.0 + 48.0 * (k / 10));
      if ((at - Vec2(309.0, 254.0)).norm() < 40.0) continue;
      const Vec2 half(9.0 * std::cos(2.4 * k), 9.0 * std::sin(2.4 * k));
      lines.push_back({between(at - half, at + half), 15.0});
    }
    return grainOf(lines, 50.0)[1];
  };
  EXPECT_FALSE(pageWith(0, 35.0));
  EXPECT_TRUE(pageWith(60, 35.0));
  EXPECT_FALSE(pageWith(60, 60.0)) << "farther than chance explains";
}

// A scanner has made the paper white but for crumbs of its tooth.
TEST(ToneGrain, OnWhitenedPaperItIsToldByTheLinesAlone) {
  constexpr double kWhite = 255.0;
  const FaintLine longLine{between({50.0, 50.0}, {550.0, 60.0}), 120.0};
  FaintLine dash{between({300.0, 250.0}, {318.0, 258.0}), 20.0};
  EXPECT_TRUE(grainOf({longLine, dash}, 0.5, kWhite)[1]);
  EXPECT_FALSE(grainOf({longLine, dash}, 0.5, kWhite, false)[1]) << "a faint pen";
  EXPECT_FALSE(grainOf({longLine, {between({300.0, 250.0}, {352.0, 275.0}), 25.0}}, 0.5, kWhite)[1])
      << "long, straight";
  dash.depth = 50.0;
  EXPECT_FALSE(grainOf({longLine, dash}, 0.5, kWhite)[1]) << "a faint stroke";
}

}  // namespace
}  // namespace batten
