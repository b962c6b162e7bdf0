// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/neighbourhood_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/image/laplacian_edges.h"
#include "tests/support/known_answers.h"
#include "tests/unit/image/random_image.h"

namespace batten {
namespace {

BitImage fromRows(const nlohmann::json& rows) {
  BitImage image(static_cast<int>(rows.at(0).get<std::string>().size()), static_cast<int>(rows.size()));
  for (int y = 0; y < image.height; ++y) {
    const auto line = rows.at(static_cast<std::size_t>(y)).get<std::string>();
    for (int x = 0; x < image.width; ++x) image.set(x, y, line[static_cast<std::size_t>(x)] == '1');
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
        FilterParams params{.coefficient = coefficient, .iterations = 9, .border = border};
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

TEST(NeighbourhoodFilter, WarnsWhenThinStrokesVanish) {
  BitImage line(100, 20);
  for (int x = 5; x < 95; ++x) line.set(x, 10, true);
  const auto result = neighbourhoodFilter(line, {}, {});
  EXPECT_EQ(result->report.inkAfter, 0);
  EXPECT_TRUE(result->report.thinStrokesLost);
}

TEST(NeighbourhoodFilter, RefusesBadParametersAndStopsWhenCancelled) {
  EXPECT_EQ(neighbourhoodFilter(BitImage(3, 3), {.coefficient = 5}, {}).error().code, ErrorCode::BadParameter);
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
