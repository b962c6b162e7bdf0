// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/neighbourhood_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/laplacian_edges.h"
#include "core/image/bits/run_pieces.h"
#include "tests/support/known_answers.h"
#include "tests/unit/image/random_image.h"

namespace batten {
namespace {

BitImage fromRows(const nlohmann::json& rows) {
  BitImage image(static_cast<int>(rows.at(0).get<std::string>().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < image.height; ++y) {
    const auto line = rows.at(y).get<std::string>();
    for (int x = 0; x < image.width; ++x) image.set(x, y, line[x] == '1');
  }
  return image;
}

/// The rule read literally, pixel by pixel.
BitImage naiveStep(const BitImage& in, int coefficient, FilterBorder border, bool erosion) {
  BitImage out = in;
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      if (in.at(x, y) != erosion) continue;
      int others = 0;
      for (int k = 0; k < 9; ++k) {
        int u = x + k % 3 - 1, v = y + k / 3 - 1;
        if (k == 4) continue;
        if (border == FilterBorder::Replicate) {
          u = std::clamp(u, 0, in.width - 1);
          v = std::clamp(v, 0, in.height - 1);
        }
        others += in.at(u, v) != erosion ? 1 : 0;
      }
      if (others > coefficient) out.set(x, y, !erosion);
    }
  }
  return out;
}

TEST(NeighbourhoodFilter, MatchesKnownAnswer) {
  const auto data = test::knownAnswer(BATTEN_TEST_DATA, "07_erosion_dilation.json");
  const BitImage image = fromRows(data.at("image"));
  const RunContext context;
  for (const auto& entry : data.at("cases")) {
    const int coefficient = entry.at("coef").get<int>();
    SCOPED_TRACE(coefficient);
    const BitImage eroded = erode(image, coefficient, FilterBorder::Paper, context);
    EXPECT_EQ(eroded, fromRows(entry.at("erosion")));
    EXPECT_EQ(dilate(image, coefficient, FilterBorder::Paper, context), fromRows(entry.at("dilation")));
    EXPECT_EQ(dilate(eroded, coefficient, FilterBorder::Paper, context), fromRows(entry.at("erosion_then_dilation")));
    EXPECT_EQ(erode(image, coefficient, FilterBorder::Replicate, context),
              fromRows(entry.at("erosion_border_replicate")));
    EXPECT_EQ(dilate(image, coefficient, FilterBorder::Replicate, context),
              fromRows(entry.at("dilation_border_replicate")));
    FilterParams params;
    params.coefficient = coefficient;
    params.iterations = 15;
    params.maxChangePx = 0;
    EXPECT_EQ(neighbourhoodFilter(image, params, context)->ink, fromRows(entry.at("ED_x15")));
    params.order = FilterOrder::DilationFirst;
    EXPECT_EQ(neighbourhoodFilter(image, params, context)->ink, fromRows(entry.at("DE_x15")));
  }
}

TEST(NeighbourhoodFilter, MatchesThePixelwiseRuleAtAnyWidth) {
  const RunContext context;
  for (const int width : {1, 2, 63, 64, 65, 127, 128, 129, 200}) {
    for (int coefficient = 0; coefficient <= 4; ++coefficient) {
      for (const auto border : {FilterBorder::Paper, FilterBorder::Replicate}) {
        SCOPED_TRACE(width * 10 + coefficient);
        const BitImage image = test::randomImage(width, 37, 0.5, static_cast<unsigned>(width));
        ASSERT_EQ(erode(image, coefficient, border, context), naiveStep(image, coefficient, border, true));
        ASSERT_EQ(dilate(image, coefficient, border, context), naiveStep(image, coefficient, border, false));
        BitImage expected = image;
        for (int i = 0; i < 9; ++i) {
          expected = naiveStep(naiveStep(expected, coefficient, border, true), coefficient, border, false);
        }
        FilterParams params{.coefficient = coefficient, .iterations = 9, .border = border, .maxChangePx = 0};
        ASSERT_EQ(neighbourhoodFilter(image, params, context)->ink, expected);
      }
    }
  }
}

TEST(NeighbourhoodFilter, StopsAtTheFixedPointAndDoesNotDependOnThreads) {
  const BitImage image = test::randomImage(300, 700, 0.55, 3);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  const FilterParams params{.coefficient = 0, .iterations = 100};
  const auto a = neighbourhoodFilter(image, params, one), b = neighbourhoodFilter(image, params, four);
  EXPECT_EQ(a->ink, b->ink);
  EXPECT_EQ(a->report.why, Termination::FixedPoint);
  EXPECT_LE(a->report.iterations, 3);  // an opening is idempotent
  EXPECT_EQ(a->report.inkBefore, image.count());
  EXPECT_EQ(a->report.inkAfter, a->ink.count());
}

/// Pair after pair over the whole image, until it rests; larger changes are undone on images of them.
FilteredImage filteredPlainly(const BitImage& image, const FilterParams& params) {
  FilteredImage result{image, {}};
  std::vector<BitImage> states{image};
  result.report.why = Termination::IterationLimit;
  for (int i = 0; i < params.iterations; ++i) {
    states.push_back(
        dilate(erode(states.back(), params.coefficient, params.border, {}), params.coefficient, params.border, {}));
    const std::size_t last = states.size() - 1;
    if (states[last] == states[last - 1]) {
      result.report.why = Termination::FixedPoint;
      break;
    }
    if (last < 2 || states[last] != states[last - 2]) continue;
    result.report.alternates = true;
    result.report.why = Termination::NoProgress;
    if ((params.iterations - static_cast<int>(last)) % 2 == 1) states.push_back(states[last - 1]);
    break;
  }
  result.report.iterations = static_cast<int>(states.size()) - 1;
  result.ink = states.back();
  if (params.maxChangePx > 0) {
    const PieceRule large{.minArea = params.maxChangePx + 1};
    const BitImage lost = keepPieces(without(image, result.ink), large, {});
    const BitImage gained = keepPieces(without(result.ink, image), large, {});
    result.ink = either(without(result.ink, gained), lost);
    result.report.undone = lost.count() + gained.count();
  }
  result.report.inkAfter = result.ink.count();
  result.report.inkLost = without(image, result.ink).count();
  result.report.inkGained = without(result.ink, image).count();
  return result;
}

TEST(NeighbourhoodFilter, TellsWhatWasDoneThoughOnlyRowsThatChangeAreKept) {
  RunContext context;
  context.threads = 3;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const BitImage image =
        test::randomImage(seed % 2 == 0 ? 40 : 9, seed % 3 == 0 ? 300 : 12, 0.3 + 0.005 * seed, seed);
    for (const int iterations : {1, 2, 14, 15}) {
      for (const int maxChange : {0, 3, 8}) {
        FilterParams params{.coefficient = static_cast<int>(seed % 5), .iterations = iterations};
        params.border = seed % 4 < 2 ? FilterBorder::Paper : FilterBorder::Replicate;
        params.maxChangePx = maxChange;
        const FilteredImage expected = filteredPlainly(image, params);
        const auto found = neighbourhoodFilter(image, params, context);
        ASSERT_EQ(found->ink, expected.ink) << seed;
        EXPECT_EQ(found->report.why, expected.report.why) << seed;
        EXPECT_EQ(found->report.alternates, expected.report.alternates) << seed;
        EXPECT_EQ(found->report.undone, expected.report.undone);
        EXPECT_EQ(found->report.inkAfter, expected.report.inkAfter);
        EXPECT_EQ(found->report.inkLost, expected.report.inkLost);
        EXPECT_EQ(found->report.inkGained, expected.report.inkGained);
      }
    }
  }
}

TEST(NeighbourhoodFilter, WarnsWhenThinStrokesVanish) {
  BitImage line(100, 20);
  for (int x = 5; x < 95; ++x) line.set(x, 10, true);
  const auto result = neighbourhoodFilter(line, {.maxChangePx = 0}, {});
  EXPECT_EQ(result->report.inkAfter, 0);
  EXPECT_EQ(result->report.inkLost, 90);
  EXPECT_TRUE(result->report.thinStrokesLost);
}

/// Lines of one and two pixels, a notch of two, and among them dirt: specks, a hole and a dent of one pixel.
TEST(NeighbourhoodFilter, LeavesThinStrokesAndNarrowGapsAndTakesDirtAway) {
  BitImage clean(200, 100);
  const auto fill = [](BitImage& image, int x0, int y0, int x1, int y1, bool ink) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) image.set(x, y, ink);
    }
  };
  fill(clean, 10, 10, 150, 11, true);
  fill(clean, 10, 20, 150, 22, true);
  fill(clean, 10, 40, 150, 80, true);
  fill(clean, 80, 40, 82, 65, false);
  BitImage dirty = clean;
  fill(dirty, 170, 30, 172, 32, true);
  dirty.set(180, 60, true);
  dirty.set(110, 79, false);
  dirty.set(120, 60, false);
  const auto result = neighbourhoodFilter(dirty, {}, {});
  ASSERT_TRUE(result);
  const auto differences = [&](const BitImage& image, int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) count += image.at(x, y) != clean.at(x, y) ? 1 : 0;
    }
    return count;
  };
  // The corners of the block and the ends of the lines may be rounded by a few pixels; nothing else differs.
  EXPECT_EQ(differences(result->ink, 13, 0, 147, 39), 0);
  EXPECT_EQ(differences(result->ink, 160, 0, 200, 100), 0);
  EXPECT_EQ(differences(result->ink, 20, 38, 70, 100), 0);
  EXPECT_EQ(differences(result->ink, 80, 42, 82, 62), 0);
  EXPECT_EQ(differences(result->ink, 90, 50, 140, 100), 0);
  EXPECT_GE(result->report.undone, 140);
  EXPECT_FALSE(result->report.thinStrokesLost);
  const FilterReport& report = result->report;
  EXPECT_EQ(report.inkAfter, report.inkBefore - report.inkLost + report.inkGained);
  // As in the paper, the lines and the notch go.
  const auto paper = neighbourhoodFilter(dirty, {.maxChangePx = 0}, {});
  EXPECT_FALSE(paper->ink.at(80, 10));
  EXPECT_TRUE(paper->ink.at(80, 60));
}

TEST(NeighbourhoodFilter, RefusesBadParametersAndStopsWhenCancelled) {
  EXPECT_EQ(neighbourhoodFilter(BitImage(3, 3), {.coefficient = 5}, {}).error().code, ErrorCode::BadParameter);
  EXPECT_EQ(neighbourhoodFilter(BitImage(3, 3), {.maxChangePx = -1}, {}).error().code, ErrorCode::BadParameter);
  EXPECT_EQ(neighbourhoodFilter(BitImage(3, 3), {.iterations = 101}, {}).error().code, ErrorCode::BadParameter);
  RunContext context;
  context.cancel.cancel();
  EXPECT_EQ(neighbourhoodFilter(BitImage(3, 3), {}, context).error().code, ErrorCode::Cancelled);
}

TEST(LaplacianEdges, AreTheInkPixelsThatTouchPaper) {
  for (const int width : {1, 63, 64, 65, 130}) {
    const BitImage image = test::randomImage(width, 40, 0.85, 9);
    const auto edges = laplacianEdges(image, {});
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < width; ++x) {
        bool inner = true;
        for (int k = 0; k < 9; ++k) inner = inner && image.at(x + k % 3 - 1, y + k / 3 - 1);
        ASSERT_EQ(edges->at(x, y), image.at(x, y) && !inner) << width << ": " << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace batten
