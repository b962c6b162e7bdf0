// SPDX-License-Identifier: GPL-3.0-or-later
// Shading that lines are drawn on and around is paper to them; shapes, solids and hatching are not.
#include "core/image/tones/tone_areas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/image/page_preparation.h"
#include "core/image/tones/without_tones.h"
#include "tests/support/stress_page.h"
#include "tests/support/tones_on.h"

namespace batten {
namespace {

constexpr auto tonesOn = test::tonesOn<findToneAreas>;

constexpr int kPageWidth = 640, kPageHeight = 480;
constexpr double kPaperGrey = 235.0, kToneGrey = 105.0;

/// How far a place lies inside the drum, px: a box with elliptic lid and bottom, as a designer draws a seat.
double insideDrum(double x, double y) {
  const double u = (x - 320.0) / 180.0, bulge = 30.0 * std::sqrt(std::max(0.0, 1.0 - u * u));
  return std::min({180.0 - std::abs(x - 320.0), y - 180.0 + bulge, 340.0 + bulge - y});
}
/// Distance from the lower edge of the lid, drawn on the tone.
double fromLid(double x, double y) {
  const double u = (x - 320.0) / 180.0;
  return std::abs(u) > 1.0 ? 100.0 : std::abs(y - 180.0 - 30.0 * std::sqrt(1.0 - u * u));
}

using Distance = std::function<double(double x, double y)>;

constexpr double kInkGrey = 40.0, kBlur = 0.8;

/// 0..1 of a place that is `inside` px within an edge, blurred.
double cover(double inside) { return 0.5 * std::erfc(-inside / (std::sqrt(2.0) * kBlur)); }

struct Drawing {
  Distance tone = [](double, double) { return 0.0; };    ///< 0..1 of shading at a place.
  Distance line = [](double, double) { return 100.0; };  ///< From the nearest line, px.
  double toneGrey = kToneGrey, lineWidthPx = 3.0, noise = 2.0;
};

/// With a circle of line on bare paper beside it.
Scan pageOf(const Drawing& d) {
  const auto grey = [&](double x, double y) {
    const double ground = kPaperGrey + (d.toneGrey - kPaperGrey) * d.tone(x, y);
    const double from = std::min(d.line(x, y), std::abs(std::hypot(x - 60.0, y - 240.0) - 45.0));
    return ground + (kInkGrey - ground) * cover(0.5 * d.lineWidthPx - from);
  };
  const std::vector<float> noInk(std::ptrdiff_t{kPageWidth} * kPageHeight, 0.0f);
  return test::renderStress(noInk, kPageWidth, kPageHeight, grey, {1.0, d.noise, 0.0}, 3);
}

Drawing drum() {
  Drawing d;
  d.tone = [](double x, double y) { return cover(insideDrum(x, y)); };
  d.line = [](double x, double y) { return std::min(std::abs(insideDrum(x, y)), fromLid(x, y)); };
  return d;
}

TEST(ToneAreas, LinesOnAndAroundShadingStandOutAsOnPaper) {
  const Scan scan = pageOf(drum());
  const auto areas = tonesOn(scan.grey, {});
  ASSERT_TRUE(areas);
  EXPECT_NEAR(areas->share, (360.0 * 160.0 + 3.14 * 180.0 * 30.0) / (kPageWidth * kPageHeight), 0.03);
  const GreyImage page = withoutTones(scan.grey, *areas, {});
  double tone = 0.0, before = 0.0;
  for (int x = 240; x < 400; ++x) {
    tone += page.level(x, 280) / 160.0;
    before += scan.grey.level(x, 280) / 160.0;
  }
  EXPECT_NEAR(before, kToneGrey, 3.0);
  EXPECT_NEAR(tone, kPaperGrey, 20.0);
  EXPECT_LT(page.level(320, 210), 0.6 * kPaperGrey) << "the lid's lower edge";
  EXPECT_LT(page.level(320, 370), 0.6 * kPaperGrey) << "the outline";
  EXPECT_EQ(page.row(20)[600], scan.grey.row(20)[600]) << "paper is untouched";
  EXPECT_EQ(page.row(240)[105], scan.grey.row(240)[105]) << "lines elsewhere are untouched";
}

TEST(ToneAreas, AFadeNeedsNoLine) {
  Drawing d = drum();  // the tone fades towards the bottom, which has no line
  d.tone = [](double x, double y) {
    return cover(180.0 - std::abs(x - 320.0)) * cover(insideDrum(x, std::min(y, 200.0))) *
           std::clamp((400.0 - y) / 200.0, 0.0, 1.0);
  };
  d.line = [](double x, double y) {
    return y < 320.0 ? std::min(std::abs(insideDrum(x, std::min(y, 250.0))), fromLid(x, y)) : 100.0;
  };
  const Scan scan = pageOf(d);
  const auto areas = tonesOn(scan.grey, {});
  ASSERT_TRUE(areas);
  const GreyImage page = withoutTones(scan.grey, *areas, {});
  for (int y = 250; y <= 390; y += 20) EXPECT_GT(page.level(320, y), 0.9 * kPaperGrey) << "at " << y;
}

// A marker's edge is where the drawing ends, whether a line was drawn along it or not.
TEST(ToneAreas, ABareSharpBorderBecomesALineWhereTheToneEnds) {
  Drawing d = drum();
  d.line = [](double x, double y) { return x < 380.0 ? std::min(std::abs(insideDrum(x, y)), fromLid(x, y)) : 100.0; };
  const Scan scan = pageOf(d);
  const auto areas = tonesOn(scan.grey, {});
  ASSERT_TRUE(areas);
  ASSERT_TRUE(areas->bare);
  const GreyImage page = withoutTones(scan.grey, *areas, {});
  for (int y = 210; y <= 320; y += 10) {
    double dark = 0.0, moment = 0.0;
    for (int x = 490; x < 510; ++x) {
      const double depth = std::max(0.0, kPaperGrey - page.level(x, y) - 25.0);
      dark += depth, moment += depth * (x + 0.5);
    }
    ASSERT_GT(dark, 60.0) << "at " << y;
    EXPECT_NEAR(moment / dark, 500.0, 0.5) << "at " << y;
    EXPECT_GT(page.level(470, y), 0.85 * kPaperGrey) << "at " << y;
  }
}

// The rim of a broad marker's stroke is darker than its inside, but not as lines are.
TEST(ToneAreas, AHalfBareAreaHardlyLighterThanItsRimIsAShape) {
  const auto isTone = [](double lastLine) {
    Drawing d = drum();
    d.line = [=](double x, double y) {
      return x < lastLine ? std::min(std::abs(insideDrum(x, y)), fromLid(x, y)) : 100.0;
    };
    return tonesOn(pageOf(d).grey, {}).has_value();
  };
  EXPECT_TRUE(isTone(600.0)) << "with lines all around";
  EXPECT_FALSE(isTone(340.0));
}

// On a page whose sides the pixels of the areas do not divide, with any number of threads.
TEST(ToneAreas, ABareBorderIsALineWhereThePageHasIt) {
  constexpr int kColumns = 300, kRows = 170, kTimes = 2;
  constexpr double kEdge = 301.3, kTone = 0.5;
  GreyImage scanned(kTimes * kColumns + 1, kTimes * kRows + 1);
  for (int y = 0; y < scanned.height; ++y)
    for (int x = 0; x < scanned.width; ++x) {
      const double level = kPaperGrey * (1.0 - (1.0 - kTone) * cover(kEdge - x - 0.5));
      scanned.row(y)[x] = static_cast<std::uint16_t>(GreyImage::kGreyUnit * level);
    }
  ToneAreas areas;
  areas.pixelsPerPx = kTimes, areas.columns = kColumns, areas.rows = kRows;
  areas.lineWidthPx = 6.0, areas.lineDarkness = 200.0;
  areas.paper.assign(std::ptrdiff_t{kColumns} * kRows, static_cast<std::uint8_t>(kPaperGrey));
  areas.ground.assign(areas.paper.size(), 255);
  areas.gain = ToneAreas::MostGain{areas.ground};
  std::vector<std::uint8_t>& bare = areas.bare.emplace(areas.paper.size(), std::uint8_t{0});
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < 150; ++i) areas.ground[std::ptrdiff_t{j} * kColumns + i] = 128;
    if (j > 30) bare[std::ptrdiff_t{j} * kColumns + 149] = 255;
  }
  RunContext one, eight;
  one.threads = 1, eight.threads = 8;
  const GreyImage page = withoutTones(scanned, areas, one);
  EXPECT_EQ(page, withoutTones(scanned, areas, eight));
  for (int y = 100; y < scanned.height; y += 20) {
    double dark = 0.0, moment = 0.0;
    for (int x = 290; x < 313; ++x) {
      const double depth = std::max(0.0, kPaperGrey - page.level(x, y) - 60.0);
      dark += depth, moment += depth * (x + 0.5);
    }
    ASSERT_GT(dark, 100.0) << "at " << y;
    EXPECT_NEAR(moment / dark, kEdge, 0.6) << "at " << y;
    EXPECT_NEAR(page.level(200, y), kPaperGrey, 3.0) << "at " << y;
    EXPECT_EQ(page.row(y)[400], scanned.row(y)[400]) << "at " << y;
  }
  EXPECT_GT(page.level(301, 20), 0.5 * kPaperGrey) << "no line where the border is not bare";
}

TEST(ToneAreas, TheGrainOfADarkToneIsNotRaisedToLines) {
  Drawing d = drum();
  d.tone = [](double x, double y) {
    const double grain = 0.2 * std::sin(1.9 * x + 0.4 * y) * std::sin(2.3 * y - 0.6 * x);
    return cover(insideDrum(x, y)) * (1.0 + grain);
  };
  const Scan scan = pageOf(d);
  auto areas = tonesOn(scan.grey, {});
  ASSERT_TRUE(areas);
  // [grey] Between the 5 % quantile and the median, and the 1 % quantile, beside the lines.
  const auto spreadOf = [](const GreyImage& page) {
    std::vector<double> levels;
    for (int y = 225; y < 330; ++y)
      for (int x = 180; x < 460; ++x) levels.push_back(page.level(x, y));
    std::sort(levels.begin(), levels.end());
    return std::pair(levels[levels.size() / 2] - levels[levels.size() * 5 / 100], levels[levels.size() / 100]);
  };
  const GreyImage page = withoutTones(scan.grey, *areas, {});
  const auto [spread, darkest] = spreadOf(page);
  EXPECT_LT(spread, 0.375 * (kPaperGrey - kInkGrey)) << "lines are taken from half of it on";
  EXPECT_LT(page.level(320, 210), darkest) << "the lid's lower edge is darker";
  areas->gain = ToneAreas::MostGain{std::vector<std::uint8_t>(areas->ground.size(), 255)};
  EXPECT_LT(spread, 0.85 * spreadOf(withoutTones(scan.grey, *areas, {})).first) << "than as deep as on paper";
}

TEST(ToneAreas, BlackThatTouchesATonePersists) {
  Drawing d = drum();
  d.line = [](double x, double y) {
    const double black = std::hypot(x - 320.0, y - 330.0) - 45.0;  // a wheel
    return std::min({std::abs(insideDrum(x, y)), fromLid(x, y), std::max(0.0, black)});
  };
  const Scan scan = pageOf(d);
  const auto areas = tonesOn(scan.grey, {});
  ASSERT_TRUE(areas);
  const GreyImage page = withoutTones(scan.grey, *areas, {});
  EXPECT_LT(page.level(320, 330), 70.0);
  EXPECT_LT(page.level(320, 295), 70.0);
  EXPECT_GT(page.level(250, 260), 0.9 * kPaperGrey) << "the tone beside it";
}

TEST(ToneAreas, NoiseOfThePaperIsNoShading) {
  Drawing d = drum();
  d.noise = 6.0;
  const Scan scan = pageOf(d);
  const auto areas = tonesOn(scan.grey, {});
  ASSERT_TRUE(areas);
  const GreyImage page = withoutTones(scan.grey, *areas, {});
  for (int x = 10; x < kPageWidth; x += 7) ASSERT_EQ(page.row(20)[x], scan.grey.row(20)[x]) << x;
}

TEST(ToneAreas, AreTheSameWithAnyNumberOfThreads) {
  const Scan scan = pageOf(drum());
  RunContext one, eight;
  one.threads = 1, eight.threads = 8;
  const auto a = tonesOn(scan.grey, one), b = tonesOn(scan.grey, eight);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->ground, b->ground);
  EXPECT_EQ(withoutTones(scan.grey, *a, one), withoutTones(scan.grey, *b, eight));
}

TEST(ToneAreas, AreNotLookedForAfterACancel) {
  RunContext context;
  context.cancel.cancel();
  EXPECT_FALSE(tonesOn(pageOf(drum()).grey, context));
}

TEST(ToneAreas, ShapesSolidsAndHatchingStayInk) {
  std::vector<std::pair<const char*, Drawing>> drawings;
  Drawing bare = drum();
  bare.line = [](double, double) { return 100.0; };
  drawings.emplace_back("a grey shape without lines", bare);
  Drawing inner = drum();
  inner.line = fromLid;
  drawings.emplace_back("a grey shape with a line inside, but none around", inner);
  Drawing soft;
  soft.tone = [](double x, double y) {
    return std::exp(-0.5 * std::pow(std::hypot(x - 340.0, y - 240.0) / 60.0, 4.0));
  };
  soft.toneGrey = 60.0;
  drawings.emplace_back("an airbrushed spot without lines", soft);
  Drawing solid = drum();
  solid.toneGrey = 35.0;
  drawings.emplace_back("a solid", solid);
  Drawing hatched;
  hatched.line = [](double x, double y) {
    const double along = std::fmod(x + y, 7.0);
    return insideDrum(x, y) > 0.0 ? std::min(std::abs(insideDrum(x, y)), std::min(along, 7.0 - along))
                                  : std::abs(insideDrum(x, y));
  };
  drawings.emplace_back("hatching", hatched);
  Drawing lines;
  lines.line = [](double x, double y) { return std::min(std::abs(insideDrum(x, y)), fromLid(x, y)); };
  drawings.emplace_back("lines alone", lines);
  for (const auto& [name, drawing] : drawings) EXPECT_FALSE(tonesOn(pageOf(drawing).grey, {})) << name;
}

TEST(ToneAreas, AreFoundOnALargePageToo) {
  const Scan small = pageOf(drum());
  Scan large = small;
  const int times = 4;
  large.grey = GreyImage(times * kPageWidth, times * kPageHeight);
  for (int y = 0; y < large.grey.height; ++y)
    for (int x = 0; x < large.grey.width; ++x) large.grey.row(y)[x] = small.grey.row(y / times)[x / times];
  const auto areas = tonesOn(large.grey, {});
  ASSERT_TRUE(areas);
  EXPECT_EQ(areas->pixelsPerPx, 2);
  const GreyImage page = withoutTones(large.grey, *areas, {});
  EXPECT_NEAR(page.level(times * 320, times * 280), kPaperGrey, 25.0);
  EXPECT_LT(page.level(times * 320 + 2, times * 210 + 2), 0.6 * kPaperGrey);
}

TEST(ToneAreas, TinyAndUniformPagesHaveNone) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 7}, {16, 16}, {40, 3}, {1, 4000}, {4000, 2}, {1751, 30}})
    EXPECT_FALSE(tonesOn(GreyImage(width, height, 20000), {})) << width << " x " << height;
  EXPECT_FALSE(tonesOn(GreyImage::uniform(900, 700, 20000), {}));
}

TEST(ToneAreas, AreLeftOutOfThePageUnlessKept) {
  const Scan scan = pageOf(drum());
  const auto page = preparePage(scan, {}, {});
  ASSERT_TRUE(page);
  EXPECT_GT(page->shadedShare, 0.1);
  ASSERT_EQ(page->notes.size(), 1u);
  EXPECT_NE(page->notes[0].find("paper.shading=keep"), std::string::npos);
  PreparationParams keep;
  keep.shading = ShadingUse::Keep;
  const auto kept = preparePage(scan, keep, {});
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->isUntouched());
}

}  // namespace
}  // namespace batten
