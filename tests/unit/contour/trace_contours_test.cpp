// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/trace_contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/contour_shapes.h"

namespace batten {
namespace {

using test::RenderSettings;

struct OutlinePage {
  GreyImage grey;
  BitImage ink;
};

OutlinePage render(const std::function<bool(double, double)>& inside, double noise = 3.0) {
  RenderSettings s;
  s.width = 400;
  s.height = 300;
  s.noise = noise;
  OutlinePage page{renderShape(inside, s), {}};
  page.ink = test::thresholdMask(page.grey, 135.0);
  return page;
}

bool inDisc(double x, double y, double cx, double cy, double r) { return std::hypot(x - cx, y - cy) < r; }

// Two discs, a ring of 3 px and a short dash.
OutlinePage mixedPage() {
  return render([](double x, double y) {
    const double ring = std::hypot(x - 300, y - 80);
    return inDisc(x, y, 100, 100, 60) || inDisc(x, y, 330, 230, 30) || std::abs(ring - 50.0) < 1.5 ||
           (x > 30 && x < 50 && std::abs(y - 260) < 1.5);
  });
}

EdgeParams withMode(EdgeMode mode) {
  EdgeParams p;
  p.mode = mode;
  return p;
}

TEST(TraceContours, ShapesGiveOutlinesAndStrokesCentreLines) {
  const OutlinePage page = mixedPage();
  ContourParams any;
  any.minLengthPx = 0.0;
  const auto set = traceContours(page.ink, page.grey, withMode(EdgeMode::Automatic), any, {});
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(set->contours.size(), 4u);
  EXPECT_EQ(set->contours[0].kind, ContourKind::Outline);
  EXPECT_EQ(set->contours[1].kind, ContourKind::Centreline);
  EXPECT_EQ(set->contours[2].kind, ContourKind::Outline);
  EXPECT_EQ(set->contours[3].kind, ContourKind::Centreline);
  EXPECT_NEAR(set->contours[0].lengthPx, 2 * M_PI * 60, 2.0);
  EXPECT_NEAR(set->contours[0].areaPx, M_PI * 3600, 40.0);
  EXPECT_NEAR(set->contours[1].lengthPx, 2 * M_PI * 50, 2.0);
  for (const Contour& c : set->contours) {
    for (const ContourPoint& p : c.points) EXPECT_FALSE(p.bundle);
    EXPECT_EQ(strokeWidthsOf(c.points).size(), c.kind == ContourKind::Centreline ? c.points.size() : 0u);
  }
  EXPECT_GT(set->report.refinedShare, 0.97);
}

// Crossing lines of 3.5 px with 5 px of paper between them, over the whole page: no middle can be told, but there is
// something to show.
TEST(TraceContours, ANetThatIsMoreInkThanPaperGivesItsBorders) {
  for (const auto& [period, ink] : {std::pair(12.0, 5.0), std::pair(10.0, 5.0), std::pair(14.0, 8.0)}) {
    const OutlinePage net = render([period = period, ink = ink](double x, double y) {
      return std::fmod(x + y, period) < ink || std::fmod(x - y + 900.0, period) < ink;
    });
    const auto set = traceContours(net.ink, net.grey, withMode(EdgeMode::Automatic), {}, {});
    ASSERT_TRUE(set.has_value()) << period << " " << ink << " " << set.error().message;
    EXPECT_GT(set->contours.size(), 100u) << period << " " << ink;
    EXPECT_NE(set->report.note.find("too close together to be told apart"), std::string::npos) << set->report.note;
  }
  // Dots are no net.
  const OutlinePage specks = render([](double x, double y) { return inDisc(x, y, 100, 100, 1.5); });
  EXPECT_FALSE(traceContours(specks.ink, specks.grey, withMode(EdgeMode::Centreline), {}, {}).has_value());
}

// Rings that the user leaves out as too short are no net, however many holes they have.
TEST(TraceContours, WhatIsLeftOutAsShortIsNoNet) {
  const OutlinePage rings = render([](double x, double y) {
    const double away = std::hypot(std::fmod(x, 30.0) - 15.0, std::fmod(y, 30.0) - 15.0);
    return std::fabs(y - 60.0) < 1.5 || (y > 75.0 && std::fabs(away - 8.0) < 1.5);
  });
  ContourParams longOnes;
  longOnes.minWidths = 30.0;
  const auto set = traceContours(rings.ink, rings.grey, withMode(EdgeMode::Automatic), longOnes, {});
  ASSERT_TRUE(set.has_value()) << set.error().message;
  EXPECT_EQ(set->contours.size(), 1u);
  EXPECT_EQ(set->report.note.find("too close together"), std::string::npos) << set->report.note;
}

TEST(TraceContours, ModesOverrideTheChoice) {
  const OutlinePage page = mixedPage();
  const auto outlines = traceContours(page.ink, page.grey, withMode(EdgeMode::Outline), {}, {});
  const auto lines = traceContours(page.ink, page.grey, withMode(EdgeMode::Centreline), {}, {});
  ASSERT_TRUE(outlines.has_value());
  ASSERT_TRUE(lines.has_value());
  for (const Contour& c : outlines->contours) EXPECT_EQ(c.kind, ContourKind::Outline);
  for (const Contour& c : lines->contours) EXPECT_EQ(c.kind, ContourKind::Centreline);
  EXPECT_EQ(outlines->report.droppedHoles, 1);
  ContourParams longOnes;
  longOnes.minWidths = 20.0;
  const auto fewer = traceContours(page.ink, page.grey, withMode(EdgeMode::Outline), longOnes, {});
  ASSERT_TRUE(fewer.has_value());
  EXPECT_LT(fewer->contours.size(), outlines->contours.size()) << "short ones are left out here, too";
  EdgeParams inner = withMode(EdgeMode::Outline);
  inner.internal = InnerBorders::On;
  const auto both = traceContours(page.ink, page.grey, inner, {}, {});
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->contours.size(), outlines->contours.size() + 1);
}

// Two discs, a ring of 3 px and a dash: the ring is to be followed along its border, a disc along its middle.
TEST(TraceContours, ChosenInkGoesItsOwnWay) {
  const OutlinePage page = mixedPage();
  for (const EdgeMode mode : {EdgeMode::Automatic, EdgeMode::Outline, EdgeMode::Centreline}) {
    EdgeParams params = withMode(mode);
    // Near the ring, not on it; on the ring again, which counts; the second place is nowhere near any ink.
    params.choices = {
        {{365, 80}, EdgeMode::Centreline}, {{20, 200}, EdgeMode::Outline}, {{300, 36}, EdgeMode::Outline}};
    const auto set = traceContours(page.ink, page.grey, params, {}, {});
    ASSERT_TRUE(set.has_value());
    int ringLines = 0;
    for (const Contour& c : set->contours) {
      const bool isRing = std::abs((c.points[0].at - Vec2(300, 80)).norm() - 50.0) < 4.0;
      ringLines += isRing;
      if (isRing) {
        EXPECT_EQ(c.kind, ContourKind::Outline);
        EXPECT_NEAR(c.lengthPx, 2 * M_PI * (c.hole ? 48.5 : 51.5), 2.0);
        ASSERT_TRUE(c.traceMode);
        EXPECT_EQ(*c.traceMode, params.choices[2]);
      } else {
        EXPECT_FALSE(c.traceMode);
        const bool isBig = (c.points[0].at - Vec2(100, 100)).norm() < 70.0;
        const bool isOutline = c.kind == ContourKind::Outline;
        EXPECT_TRUE(mode == EdgeMode::Automatic ? !isBig || isOutline : isOutline == (mode == EdgeMode::Outline));
      }
    }
    EXPECT_EQ(ringLines, mode == EdgeMode::Outline ? 1 : 2) << "holes of shapes are followed";
  }
}

TEST(TraceContours, AChoiceSurvivesAsLongAsItsInkIsNear) {
  const OutlinePage page = mixedPage();
  EdgeParams params = withMode(EdgeMode::Outline);
  for (const double away : {0.0, 10.0, 20.0, 30.0}) {
    params.choices = {{{300, 80 + 51.5 + away}, EdgeMode::Centreline}};
    const auto set = traceContours(page.ink, page.grey, params, {}, {});
    ASSERT_TRUE(set.has_value());
    const auto chosen = std::count_if(set->contours.begin(), set->contours.end(), [](const Contour& c) {
      return c.kind == ContourKind::Centreline && c.traceMode;
    });
    EXPECT_EQ(chosen, away < kInkReachPx ? 1 : 0) << away;
  }
  params.choices = {{{std::nan(""), 0.0}, EdgeMode::Outline}};
  EXPECT_FALSE(traceContours(page.ink, page.grey, params, {}, {}));
}

// The mean of merged strokes lies on paper.
TEST(TraceContours, AMergedLineKnowsTheInkItIsMadeOf) {
  const OutlinePage page = render(
      [](double x, double y) { return x > 40 && x < 360 && (std::abs(y - 140.3) < 2.0 || std::abs(y - 155.2) < 2.0); });
  EdgeParams params;
  params.mergeWidths = 6.0;
  auto set = traceContours(page.ink, page.grey, params, {}, {});
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(set->contours.size(), 1u);
  const Vec2 place = placeOnInk(set->contours[0]);
  EXPECT_LT(std::min(std::abs(place.y() - 140.3), std::abs(place.y() - 155.2)), 4.0);
  params.choices = {{place, EdgeMode::Centreline}};
  set = traceContours(page.ink, page.grey, params, {}, {});
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(set->contours.size(), 1u);
  EXPECT_TRUE(set->contours[0].traceMode);
  EXPECT_TRUE(set->report.note.empty()) << set->report.note;
}

TEST(TraceContours, APlaceOnTheInkIsNotOverAGap) {
  Contour c;
  for (int i = 0; i < 101; ++i) {
    const Vec2 at(static_cast<double>(i), 0.0);
    c.points.push_back({.at = at, .unrefined = at});
  }
  EXPECT_EQ(placeOnInk(c), Vec2(50, 0));
  c.bridges = {{40, 55}};
  EXPECT_EQ(placeOnInk(c), Vec2(56, 0));
}

// What the user sets is the paper between the ends, whatever the pen's shape and the direction.
TEST(TraceContours, AGapIsAsLongAsItLooks) {
  for (const double w : {3.0, 5.0, 9.0}) {
    for (const double turn : {0.0, 0.4}) {
      for (const bool isSquare : {true, false}) {
        const double gap = 4.0 * w;
        const Vec2 along(std::cos(turn), std::sin(turn)), across = leftNormal(along);
        const OutlinePage p = render([&](double x, double y) {
          const Vec2 d = Vec2(x, y) - Vec2(200.3, 150.4);
          const double u = std::abs(d.dot(along)) - 0.5 * gap, v = std::abs(d.dot(across));
          if (u < 0.0 || u > 110.0) return false;
          return isSquare || u > 0.5 * w ? v < 0.5 * w : std::hypot(u - 0.5 * w, v) < 0.5 * w;
        });
        EdgeParams params;
        params.mode = EdgeMode::Centreline;
        const auto linesWith = [&](double factor) {
          params.gapFactor = factor;
          const auto set = traceContours(p.ink, p.grey, params, {}, {});
          return set ? set->contours.size() : 0u;
        };
        // The width of a stroke is known to half a pixel, its gap to one.
        const double doubt = (1.2 + 0.5 * gap / w) / w;
        EXPECT_EQ(linesWith(4.0 + doubt), 1u) << w << " " << turn << " " << isSquare;
        EXPECT_EQ(linesWith(4.0 - doubt), 2u) << w << " " << turn << " " << isSquare;
      }
    }
  }
}

TEST(TraceContours, LongestFirstShortOnesDroppedAndTheCutIsSaid) {
  const OutlinePage page = mixedPage();
  ContourParams params;
  params.minLengthPx = 60.0;
  const auto set = traceContours(page.ink, page.grey, {}, params, {});
  ASSERT_TRUE(set.has_value());
  EXPECT_EQ(set->contours.size(), 3u);
  EXPECT_EQ(set->report.droppedShort, 1);
  for (std::size_t i = 1; i < set->contours.size(); ++i)
    EXPECT_GE(set->contours[i - 1].lengthPx, set->contours[i].lengthPx);
  params.maxCount = 2;
  const auto cut = traceContours(page.ink, page.grey, {}, params, {});
  ASSERT_TRUE(cut.has_value());
  EXPECT_EQ(cut->contours.size(), 2u);
  EXPECT_NE(cut->report.note.find("2 longest of 3"), std::string::npos);
}

// A halftone has more dots than any drawing lines: time and memory are bounded, and it is said.
TEST(TraceContours, WithoutALimitThereIsOneAllTheSame) {
  constexpr int kAcross = 161, kDown = 130, kPitchPx = 8;
  BitImage ink(kAcross * kPitchPx + 20, kDown * kPitchPx + 20);
  GreyImage grey(ink.width, ink.height, 235 * 257);
  for (int y = 0; y < kDown * kPitchPx; ++y) {
    for (int x = 0; x < kAcross * kPitchPx; ++x) {
      if (x % kPitchPx >= 5 || y % kPitchPx >= 5) continue;
      ink.set(x + 10, y + 10, true);
      grey.row(y + 10)[x + 10] = 20 * 257;
    }
  }
  EdgeParams edges;
  edges.mode = EdgeMode::Outline;
  const auto set = traceContours(ink, grey, edges, {}, {});
  ASSERT_TRUE(set.has_value());
  EXPECT_EQ(set->contours.size(), 20000u);
  EXPECT_NE(set->report.note.find("20000 longest of 20930"), std::string::npos) << set->report.note;
}

TEST(TraceContours, MarginsOfTheScannerAreNoLines) {
  const OutlinePage page = render([](double x, double y) {
    return x < 4 + 0.5 * std::sin(y * 0.1) || y > 297 || (std::abs(y - 150 - 0.2 * x) < 2.0 && x < 399);
  });
  const auto set = traceContours(page.ink, page.grey, {}, {}, {});
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(set->contours.size(), 1u);
  EXPECT_EQ(set->report.droppedMargins, 1);
  for (const Vec2& p : positionsOf(set->contours[0].points)) EXPECT_NEAR(p.y(), 150 + 0.2 * p.x(), 4.0);
}

// Of not quite three widths: one line each.
TEST(TraceContours, DashesInARowAreLines) {
  const OutlinePage page = render([&](double x, double y) {
    bool isInk = std::abs(y - 150.0 - 0.3 * x) < 2.5 && x > 20.0 && x < 380.0;
    for (int k = 0; k < 10; ++k) isInk = isInk || (std::abs(x - 60.0 - 27.0 * k) < 6.5 && std::abs(y - 60.0) < 2.5);
    return isInk;
  });
  const auto set = traceContours(page.ink, page.grey, {}, {}, {});
  ASSERT_TRUE(set.has_value());
  const auto inRow = std::count_if(set->contours.begin(), set->contours.end(), [](const Contour& c) {
    return c.kind == ContourKind::Centreline && std::abs(c.points.front().at.y() - 60.0) < 4.0;
  });
  EXPECT_EQ(inRow, 10);
}

// A tone laid up to a curved edge that fades out below it: no line is drawn, the edge itself is followed.
TEST(TraceContours, EdgesOfTonesAreFollowedWhereTheyAreSharp) {
  constexpr int kWidth = 500, kHeight = 400;
  const auto edge = [](double x) { return 140.0 + 30.0 * std::sin(x / 90.0); };
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 3.0);
  GreyImage grey(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double u = x + 0.5, slope = std::cos(u / 90.0) / 3.0;
      const double d = (y + 0.5 - edge(u)) / std::sqrt(1.0 + slope * slope);
      const double sides = std::clamp(std::min(u - 40.0, 460.0 - u) / 60.0, 0.0, 1.0);
      const double tone = 60.0 * std::max(0.0, 1.0 - std::max(0.0, d) / 160.0) * sides * 0.5 * std::erfc(-d / 1.2);
      const double level = std::clamp(235.0 - tone + noise(random), 0.0, 255.0);
      grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(level * GreyImage::kGreyUnit));
    }
  }
  BitImage ink(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      double sum = 0.0;
      for (int j = -3; j <= 3; ++j) {
        for (int i = -3; i <= 3; ++i) {
          sum += grey.level(std::clamp(x + i, 0, kWidth - 1), std::clamp(y + j, 0, kHeight - 1));
        }
      }
      ink.set(x, y, sum / 49.0 < 205.0);
    }
  }
  const auto set = traceContours(ink, grey, withMode(EdgeMode::Outline), {}, {});
  ASSERT_TRUE(set.has_value());
  ASSERT_EQ(set->contours.size(), 1u);
  const Contour& line = set->contours[0];
  EXPECT_FALSE(line.closed);
  EXPECT_GT(line.lengthPx, 330.0);
  EXPECT_LT(line.lengthPx, 460.0);
  double square = 0.0;
  int count = 0;
  for (std::size_t i = 25; i + 25 < line.points.size(); ++i) {
    const Vec2& p = line.points[i].at;
    const double slope = std::cos(p.x() / 90.0) / 3.0;
    square += std::pow((p.y() - edge(p.x())) / std::sqrt(1.0 + slope * slope), 2);
    ++count;
  }
  EXPECT_LE(std::sqrt(square / count), 0.15);
}

TEST(TraceContours, NothingLongEnoughSaysWhatToDo) {
  const OutlinePage page = mixedPage();
  ContourParams params;
  params.minLengthPx = 5000.0;
  const auto none = traceContours(page.ink, page.grey, {}, params, {});
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().code, ErrorCode::NoCurve);
  EXPECT_NE(none.error().message.find("5000 px"), std::string::npos);
  const auto empty = traceContours(BitImage(400, 300), page.grey, {}, {}, {});
  ASSERT_FALSE(empty.has_value());
  EXPECT_EQ(empty.error().code, ErrorCode::NoCurve);
}

TEST(TraceContours, BadInputIsRefused) {
  const OutlinePage page = mixedPage();
  EXPECT_FALSE(traceContours(BitImage(10, 10), page.grey, {}, {}, {}).has_value());
  EdgeParams edges;
  edges.mergeWidths = 21.0;
  EXPECT_FALSE(traceContours(page.ink, page.grey, edges, {}, {}).has_value());
  ContourParams params;
  params.maxCount = -1;
  EXPECT_FALSE(traceContours(page.ink, page.grey, {}, params, {}).has_value());
}

// A border of more points than one block of any loop.
TEST(TraceContours, SameOutlineWithAnyNumberOfThreads) {
  RenderSettings s;
  s.width = 1300;
  s.height = 1300;
  s.noise = 4.0;
  s.blurPx = 0.8;
  const GreyImage grey =
      renderShape([](double x, double y) { return std::hypot(x - 650, y - 650) < 570 + 20 * std::sin(x * 0.05); }, s);
  const BitImage ink = test::thresholdMask(grey, 135.0);
  std::vector<ContourSet> sets;
  for (const int threads : {1, 2, 5}) {
    RunContext context;
    context.threads = threads;
    auto set = traceContours(ink, grey, withMode(EdgeMode::Outline), {}, context);
    ASSERT_TRUE(set.has_value());
    sets.push_back(std::move(*set));
  }
  ASSERT_GE(sets[0].contours[0].points.size(), 4000u);
  for (std::size_t k = 1; k < sets.size(); ++k) {
    ASSERT_EQ(sets[k].contours.size(), sets[0].contours.size());
    EXPECT_TRUE(sets[k].contours[0].points == sets[0].contours[0].points);
  }
}

TEST(TraceContours, CancelIsObeyed) {
  const OutlinePage page = mixedPage();
  RunContext context;
  context.cancel.cancel();
  const auto set = traceContours(page.ink, page.grey, {}, {}, context);
  ASSERT_FALSE(set.has_value());
  EXPECT_EQ(set.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
