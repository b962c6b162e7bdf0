// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "core/image/fine_page.h"
#include "core/pipeline/run/pipeline.h"
#include "core/pipeline/run/stage_keys.h"
#include "tests/support/angles.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using test::kPi;
using Strokes = std::vector<std::vector<Vec2>>;

constexpr int kPageWidth = 640, kPageHeight = 420;

std::vector<Vec2> letterArc(double x, double y, double rx, double ry, double fromDeg, double toDeg) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 24; ++i) {
    const double t = (fromDeg + (toDeg - fromDeg) * i / 24.0) * kPi / 180.0;
    points.emplace_back(x + rx * std::cos(t), y + ry * std::sin(t));
  }
  return points;
}

/// Letters of height 1 on a base line at y = 1, each in a box of width .7.
std::vector<Strokes> alphabet() {
  const auto line = [](std::initializer_list<Vec2> points) { return std::vector<Vec2>(points); };
  return {
      {letterArc(0.35, 0.65, 0.33, 0.35, 0.0, 360.0)},                                       // o
      {line({{0.02, 0.65}, {0.68, 0.65}}), letterArc(0.35, 0.65, 0.33, 0.35, 0.0, -310.0)},  // e
      {letterArc(0.33, 0.68, 0.31, 0.32, 0.0, 360.0), line({{0.64, 0.0}, {0.64, 1.0}})},     // d
      {line({{0.05, 0.3}, {0.05, 1.0}}), letterArc(0.33, 0.6, 0.28, 0.28, 180.0, 360.0),
       line({{0.61, 0.6}, {0.61, 1.0}})},                                                                      // n
      {line({{0.05, 0.0}, {0.05, 1.0}}), line({{0.65, 0.0}, {0.65, 1.0}}), line({{0.05, 0.5}, {0.65, 0.5}})},  // H
      {line({{0.0, 1.0}, {0.35, 0.0}, {0.7, 1.0}}), line({{0.13, 0.65}, {0.57, 0.65}})},                       // A
      {line({{0.65, 0.0}, {0.05, 0.0}, {0.05, 1.0}, {0.65, 1.0}}), line({{0.05, 0.5}, {0.5, 0.5}})},           // E
      {line({{0.05, 1.0}, {0.05, 0.0}}), letterArc(0.3, 0.27, 0.3, 0.27, -90.0, 90.0), line({{0.3, 0.0}, {0.05, 0.0}}),
       line({{0.3, 0.54}, {0.05, 0.54}}), line({{0.3, 0.54}, {0.65, 1.0}})},  // R
  };
}

struct LetteredPage {
  Scan scan;
  std::vector<Strokes> letters;
};

/// Rows of words of one height, as captions stand on a page.
LetteredPage lettered(double height, double penPx, const test::PageStyle& style) {
  LetteredPage page;
  std::vector<float> cover(std::ptrdiff_t{kPageWidth} * kPageHeight, 0.0f);
  const std::vector<Strokes> shapes = alphabet();
  std::size_t next = 0;
  for (double y = 30.0; y + height < kPageHeight - 30.0; y += 5.0 * height) {
    for (double x = 30.0; x + 0.7 * height < kPageWidth - 30.0; x += (next % 6 == 0 ? 3.0 : 1.05) * height) {
      // Not all alike on the grid of the pixels.
      const Vec2 corner(x + 0.37 * static_cast<double>(next % 5), y + 0.29 * static_cast<double>(next % 7));
      Strokes letter = shapes[next++ % shapes.size()];
      for (std::vector<Vec2>& stroke : letter) {
        for (Vec2& p : stroke) p = corner + height * p;
        test::inkOver(cover, test::strokeCoverage(stroke, false, penPx, kPageWidth, kPageHeight));
      }
      page.letters.push_back(std::move(letter));
    }
  }
  page.scan = test::renderPage(std::move(cover), kPageWidth, kPageHeight, style);
  return page;
}

/// Places a quarter of a pixel apart along strokes.
std::vector<Vec2> placesOn(const Strokes& strokes) {
  std::vector<Vec2> places;
  for (const std::vector<Vec2>& stroke : strokes) {
    for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
      const Vec2 d = stroke[i + 1] - stroke[i];
      const int steps = std::max(1, static_cast<int>(4.0 * d.norm()));
      for (int k = 0; k < steps; ++k) places.push_back(stroke[i] + d * (static_cast<double>(k) / steps));
    }
  }
  return places;
}

double nearestPlace(const Vec2& from, const std::vector<Vec2>& places) {
  double least = 1e9;
  for (const Vec2& p : places) least = std::min(least, (p - from).squaredNorm());
  return std::sqrt(least);
}

struct Reading {
  double found = 0.0;   ///< Share of the strokes that lie within a pixel of a line.
  double wrong = 0.0;   ///< Share of the lines that is more than 1.5 px from every stroke.
  double across = 0.0;  ///< Share of the letters that one line joins with another.
};

Reading readLetters(const LetteredPage& page) {
  StageCache cache;
  const PipelineOutput output = runPipeline(page.scan, {}, cache, {StageId::Contours, {}, false}, {});
  Reading reading;
  EXPECT_TRUE(output.contours);
  if (!output.contours) return reading;
  std::vector<std::vector<Vec2>> letters;
  std::vector<Vec2> centres;
  for (const Strokes& letter : page.letters) {
    letters.push_back(placesOn(letter));
    Vec2 sum = Vec2::Zero();
    for (const Vec2& p : letters.back()) sum += p;
    centres.emplace_back(sum / static_cast<double>(letters.back().size()));
  }
  std::vector<std::vector<Vec2>> near(letters.size());
  std::set<std::size_t> joined;
  int points = 0, wrong = 0;
  for (const Contour& line : output.contours->contours) {
    std::set<std::size_t> touched;
    for (const ContourPoint& p : line.points) {
      std::size_t letter = 0;
      for (std::size_t i = 1; i < centres.size(); ++i)
        if ((centres[i] - p.at).squaredNorm() < (centres[letter] - p.at).squaredNorm()) letter = i;
      near[letter].push_back(p.at);
      ++points;
      const double off = nearestPlace(p.at, letters[letter]);
      if (off > 1.5) ++wrong;
      if (off < 0.75) touched.insert(letter);
    }
    if (touched.size() > 1) joined.insert(touched.begin(), touched.end());
  }
  int places = 0, found = 0;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    for (const Vec2& p : letters[i]) {
      ++places;
      if (nearestPlace(p, near[i]) <= 1.0) ++found;
    }
  }
  reading.found = static_cast<double>(found) / places;
  reading.wrong = static_cast<double>(wrong) / std::max(1, points);
  reading.across = static_cast<double>(joined.size()) / static_cast<double>(letters.size());
  return reading;
}

/// Small lettering is traced letter by letter: the paper between letters and most counters stay open.
TEST(ThinStrokes, OfSmallLettersAreFoundOneByOne) {
  struct Case {
    double height, penPx, noise;
    double found, wrong, across;  // what is reached, less a little
  };
  for (const Case& c : {Case{10.0, 1.6, 3.0, 0.5, 0.06, 0.45}, Case{12.0, 2.0, 4.0, 0.6, 0.06, 0.2},
                        Case{14.0, 2.0, 4.0, 0.68, 0.04, 0.05}}) {
    test::PageStyle style = test::cleanPage();
    style.paperLeft = 240.0;
    style.paperRight = 215.0;
    style.inkLevel = 70.0;
    style.blurPx = 0.8;
    style.noise = c.noise;
    style.seed = 7;
    const Reading reading = readLetters(lettered(c.height, c.penPx, style));
    EXPECT_GE(reading.found, c.found) << "letters of " << c.height << " px";
    EXPECT_LE(reading.wrong, c.wrong) << "letters of " << c.height << " px";
    EXPECT_LE(reading.across, c.across) << "letters of " << c.height << " px";
  }
}

/// A trace mode chosen beside the ink reaches as far as on any other page.
TEST(ThinStrokes, FollowATraceModeChosenBesideThem) {
  const LetteredPage page = lettered(12.0, 2.0, test::cleanPage());
  const Vec2 below = page.letters.front().front().front() + Vec2(0.0, 0.75 * kInkReachPx);
  Recipe recipe;
  recipe.edges.choices.push_back({below, EdgeMode::Outline});
  StageCache cache;
  const PipelineOutput output = runPipeline(page.scan, recipe, cache, {StageId::Contours, {}, false}, {});
  ASSERT_TRUE(output.contours);
  const auto follows = [](const Contour& line) {
    return line.traceMode.has_value() && line.kind == ContourKind::Outline;
  };
  EXPECT_TRUE(std::ranges::any_of(output.contours->contours, follows));
}

/// One stroke of 2 px on a page of a scanner.
Scan pageOfStroke(const std::vector<Vec2>& middle, bool closed, std::uint32_t seed) {
  test::PageStyle style = test::cleanPage();
  style.paperLeft = 240.0;
  style.paperRight = 215.0;
  style.inkLevel = 70.0;
  style.blurPx = 0.8;
  style.noise = 4.0;
  style.seed = seed;
  return test::renderPage(test::strokeCoverage(middle, closed, 2.0, kPageWidth, kPageHeight), kPageWidth, kPageHeight,
                          style);
}

PipelineOutput linesOf(const Scan& scan, const Recipe& recipe, StageCache& cache) {
  PipelineOutput output = runPipeline(scan, recipe, cache, {StageId::Contours, {}, false}, {});
  EXPECT_TRUE(output.contours);
  return output;
}

/// They are found on an enlargement and measured on the scan itself: no lean to a side, widths and deviations in its
/// pixels.
TEST(ThinStrokes, ArePlacedOnTheScan) {
  const Vec2 from(40.3, 60.7), to(590.2, 260.4), centre(320.4, 210.3);
  const double radius = 130.0;
  std::vector<Vec2> straight, round;
  for (int i = 0; i <= 500; ++i) straight.emplace_back(from + (to - from) * (i / 500.0));
  for (int i = 0; i < 720; ++i) {
    const double angle = 2.0 * kPi * i / 720.0;
    round.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  const Vec2 along = (to - from).normalized(), across(-along.y(), along.x());
  for (const bool isRound : {false, true}) {
    const Scan scan = pageOfStroke(isRound ? round : straight, isRound, 11);
    StageCache cache;
    const PipelineOutput output = linesOf(scan, {}, cache);
    const auto fine = cache.find<std::optional<FinePage>>(stageKeys(scan, {}, output.frame).fine);
    ASSERT_TRUE(fine && *fine) << "not traced on a fine page";
    ASSERT_EQ(output.contours->contours.size(), 1u);
    const Contour& line = output.contours->contours.front();
    EXPECT_EQ(line.closed, isRound);
    EXPECT_NEAR(line.lengthPx, isRound ? 2.0 * kPi * radius : (to - from).norm(), 3.0);
    double sum = 0.0, squares = 0.0, width = 0.0, sigma = 0.0;
    int count = 0;
    for (const ContourPoint& p : line.points) {
      if (!p.refined || !p.sigmaPx || !p.widthPx) continue;
      const double off = isRound ? (p.at - centre).norm() - radius : (p.at - from).dot(across);
      sum += off;
      squares += off * off;
      width += static_cast<double>(*p.widthPx);
      sigma += static_cast<double>(*p.sigmaPx);
      ++count;
    }
    ASSERT_GT(count, 0.9 * line.lengthPx);
    EXPECT_LT(count, 1.3 * line.lengthPx);
    const double rms = std::sqrt(squares / count);
    EXPECT_LT(std::abs(sum / count), 0.05);
    EXPECT_LT(rms, 0.15);
    // Blur makes a line of 2 px look wider.
    EXPECT_NEAR(width / count, 2.2, 0.35);
    EXPECT_GT(sigma / count, 0.4 * rms);
    EXPECT_LT(sigma / count, 2.5 * rms);
  }
}

/// A junction is reported in pixels of the scan, and a choice beside it reaches as far as on any other page.
TEST(ThinStrokes, AreLedThroughJunctionsAsChosen) {
  const Vec2 crossing(320.5, 210.5);
  std::vector<float> cover(std::ptrdiff_t{kPageWidth} * kPageHeight, 0.0f);
  for (const double angle : {0.3, 1.5}) {
    const Vec2 along(std::cos(angle), std::sin(angle));
    const std::vector<Vec2> stroke = {crossing - 150.0 * along, crossing + 150.0 * along};
    test::inkOver(cover, test::strokeCoverage(stroke, false, 2.0, kPageWidth, kPageHeight));
  }
  test::PageStyle style = test::cleanPage();
  style.blurPx = 0.8;
  style.noise = 4.0;
  const Scan scan = test::renderPage(std::move(cover), kPageWidth, kPageHeight, style);
  StageCache cache;
  const PipelineOutput led = linesOf(scan, {}, cache);
  EXPECT_EQ(led.contours->contours.size(), 2u);
  ASSERT_EQ(led.contours->junctions.size(), 1u);
  EXPECT_LT((led.contours->junctions.front().positionPx - crossing).norm(), 1.5);
  Recipe recipe;
  recipe.edges.junctions.push_back({crossing + Vec2(0.0, -0.75 * kInkReachPx), {}});
  EXPECT_EQ(linesOf(scan, recipe, cache).contours->contours.size(), 4u);
}

/// What is changed of how lines are followed makes no new fine page.
TEST(ThinStrokes, AreEnlargedOnce) {
  const Scan scan = pageOfStroke({{40.3, 60.7}, {590.2, 260.4}}, false, 5);
  StageCache cache;
  const auto fineAfter = [&](const Recipe& recipe) {
    const PipelineOutput output = linesOf(scan, recipe, cache);
    return cache.find<std::optional<FinePage>>(stageKeys(scan, recipe, output.frame).fine);
  };
  const auto first = fineAfter({});
  ASSERT_TRUE(first && *first);
  Recipe recipe;
  recipe.edges.gapFactor = 2.0;
  recipe.contours.minWidths = 5.0;
  EXPECT_EQ(fineAfter(recipe), first);
  recipe.threshold.strength = 1.2;
  EXPECT_NE(fineAfter(recipe), first);
}

}  // namespace
}  // namespace batten
