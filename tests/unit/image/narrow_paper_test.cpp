// SPDX-License-Identifier: GPL-3.0-or-later
// Thin strokes close together on a fine page, blurred as a scanner does: what a low threshold fills between them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "core/image/bits/bit_steps.h"
#include "core/image/narrow_paper.h"

namespace batten {
namespace {

constexpr int kFineSide = 120;
constexpr double kSheetGrey = 230.0, kInkDepth = 150.0, kBlurPx = 1.6, kThinStrokePx = 4.5;

double riseOfBlur(double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * kBlurPx)); }

/// 0..1 of a stroke whose middle is `offPx` away; those of strokes side by side add up.
double strokeCover(double offPx) {
  return riseOfBlur(0.5 * kThinStrokePx - offPx) * riseOfBlur(0.5 * kThinStrokePx + offPx);
}

using CoverAt = std::function<double(double x, double y)>;

struct FineInk {
  GreyImage grey{kFineSide, kFineSide};
  BitImage ink{kFineSide, kFineSide};
};

/// Ink by a threshold of an eighth of the depth, as a page with faint lines besides has it.
FineInk fineInkOf(const CoverAt& cover) {
  constexpr double kThreshold = 0.125;
  FineInk page;
  for (int y = 0; y < kFineSide; ++y) {
    for (int x = 0; x < kFineSide; ++x) {
      const double c = std::clamp(cover(x + 0.5, y + 0.5), 0.0, 1.0);
      page.grey.row(y)[x] = static_cast<std::uint16_t>((kSheetGrey - kInkDepth * c) * GreyImage::kGreyUnit);
      page.ink.set(x, y, c > kThreshold);
    }
  }
  return page;
}

PaperBackground evenPaper() {
  PaperBackground paper;
  paper.columns = paper.rows = kFineSide / paper.cellPx;
  paper.grey.assign(std::ptrdiff_t{paper.columns} * paper.rows, static_cast<float>(kSheetGrey));
  return paper;
}

BitImage opened(const FineInk& page) { return withoutNarrowPaper(page.ink, page.grey, evenPaper(), {}); }

TEST(NarrowPaper, OpensTheCounterOfALetterAndKeepsItsStroke) {
  constexpr double kRadius = 4.6;
  const FineInk page = fineInkOf([](double x, double y) {
    const double off = std::hypot(x - 60.0, y - 60.0);
    return strokeCover(kRadius - off) + strokeCover(kRadius + off);
  });
  ASSERT_TRUE(page.ink.at(60, 60));
  const BitImage ink = opened(page);
  EXPECT_FALSE(ink.at(60, 60));
  for (double a = 0.0; a < 6.28; a += 0.1)
    EXPECT_TRUE(ink.at(static_cast<int>(60.0 + kRadius * std::cos(a)), static_cast<int>(60.0 + kRadius * std::sin(a))))
        << a;
}

TEST(NarrowPaper, PartsParallelStrokesAllAlong) {
  constexpr double kPitch = 7.5, kSlope = 0.4;
  const auto off = [](double x, double y) { return (y - 60.0 - kSlope * (x - 60.0)) / std::hypot(1.0, kSlope); };
  const FineInk page = fineInkOf([&](double x, double y) {
    return strokeCover(off(x, y) - 0.5 * kPitch) + strokeCover(off(x, y) + 0.5 * kPitch);
  });
  const BitImage ink = opened(page);
  for (int x = 12; x < kFineSide - 12; ++x) {
    const double middle = 60.0 + kSlope * (x + 0.5 - 60.0), away = 0.5 * kPitch * std::hypot(1.0, kSlope);
    EXPECT_TRUE(page.ink.at(x, static_cast<int>(middle))) << x;
    EXPECT_FALSE(ink.at(x, static_cast<int>(middle))) << x;
    EXPECT_TRUE(ink.at(x, static_cast<int>(middle + away))) << x;
    EXPECT_TRUE(ink.at(x, static_cast<int>(middle - away))) << x;
  }
}

/// Along the bar both sides are darker, too; across it they are paper.
TEST(NarrowPaper, KeepsTheFaintBarOfAnH) {
  constexpr double kBarDepth = 0.5;
  const FineInk page = fineInkOf([](double x, double y) {
    const double stems = strokeCover(x - 53.0) + strokeCover(x - 67.0);
    return std::max(stems, x > 53.0 && x < 67.0 ? kBarDepth * strokeCover(y - 60.0) : 0.0);
  });
  const BitImage ink = opened(page);
  for (int x = 53; x < 67; ++x) EXPECT_TRUE(ink.at(x, 60)) << x;
}

TEST(NarrowPaper, LeavesAStrokeAsItIsWhosePressureVaries) {
  const FineInk page = fineInkOf(
      [](double x, double y) { return (0.75 + 0.25 * std::sin(x)) * strokeCover(y - 60.0 - 0.2 * (x - 60.0)); });
  EXPECT_EQ(without(page.ink, opened(page)).count(), 0);
}

TEST(NarrowPaper, EndsAtTheBorderOfThePage) {
  const FineInk page = fineInkOf([](double x, double) { return strokeCover(x); });
  EXPECT_EQ(without(page.ink, opened(page)).count(), 0);
}

constexpr double kPenPx = 6.0;  // of a stroke as the threshold leaves it

/// Two strokes, and between them paper so dark that the threshold takes it for ink.
/// @param shade of the depth of the ink, 0..1.
FineInk shadedPair(double pitch, double shade = 0.2) {
  return fineInkOf([=](double x, double y) {
    const double off = y - 60.0;
    const bool isBetween = std::abs(off) < 0.5 * pitch && x > 20.0 && x < 100.0;
    return std::max(strokeCover(off - 0.5 * pitch) + strokeCover(off + 0.5 * pitch), isBetween ? shade : 0.0);
  });
}

TEST(ClosedPaper, OpensAStrokesWidthBetweenTwoStrokes) {
  const FineInk page = shadedPair(14.0);
  ASSERT_TRUE(page.ink.at(60, 60));
  const BitImage ink = withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, {});
  EXPECT_FALSE(ink.at(60, 60));
  EXPECT_TRUE(ink.at(60, 53));
  EXPECT_TRUE(ink.at(60, 67));
}

// A pen has no grain that would rise as much; less is no paper.
TEST(ClosedPaper, OpensPaperAThirdOfTheInksDepthAboveIt) {
  const auto isOpen = [](double shade) {
    const FineInk page = shadedPair(16.0, shade);
    return !withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, {}).at(60, 60);
  };
  EXPECT_TRUE(isOpen(0.55));
  EXPECT_FALSE(isOpen(0.68));
}

TEST(ClosedPaper, LeavesWhatIsNarrowerThanThat) {
  const FineInk page = shadedPair(8.0);
  ASSERT_TRUE(page.ink.at(60, 60));
  EXPECT_EQ(without(page.ink, withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, {})).count(), 0);
}

// The counter of an a or an e is narrower than the pen.
TEST(ClosedPaper, OpensHalfAStrokesWidthInLetters) {
  const FineInk page = shadedPair(10.0);
  ASSERT_TRUE(page.ink.at(60, 60));
  const auto opened = [&](PaperBetween between) {
    return withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, {}, between);
  };
  EXPECT_TRUE(opened(PaperBetween::Strokes).at(60, 60));
  EXPECT_FALSE(opened(PaperBetween::Letters).at(60, 60));
  EXPECT_TRUE(opened(PaperBetween::Letters).at(60, 55));
  EXPECT_TRUE(opened(PaperBetween::Letters).at(60, 65));
}

TEST(ClosedPaper, LeavesATone) {
  const FineInk page = fineInkOf([](double x, double y) { return std::hypot(x - 60.0, y - 60.0) < 40.0 ? 0.3 : 0.0; });
  EXPECT_EQ(without(page.ink, withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, {})).count(), 0);
}

TEST(ClosedPaper, IsTheSameWithAnyNumberOfThreads) {
  const FineInk page = shadedPair(14.0);
  RunContext one, four;
  one.threads = 1;
  four.threads = 4;
  EXPECT_EQ(withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, one),
            withoutClosedPaper(page.ink, page.grey, evenPaper(), kPenPx, four));
}

/// Two strokes side by side, of which the threshold takes all for ink.
FineInk closePair(double depth) {
  constexpr double kPitch = 9.0;
  return fineInkOf([=](double x, double) {
    return depth * std::max(strokeCover(x - 60.0 - 0.5 * kPitch) + strokeCover(x - 60.0 + 0.5 * kPitch), 0.2);
  });
}

TEST(ClearPaper, IsFoundBetweenDarkStrokesAndNotBetweenPaleOnes) {
  const FineInk dark = closePair(1.0), pale = closePair(0.65);
  ASSERT_EQ(dark.ink.count(), std::int64_t{kFineSide} * kFineSide);
  const BitImage found = clearPaper(dark.ink, dark.grey, evenPaper(), kPenPx, {});
  for (int y = 10; y < kFineSide - 10; ++y) {
    EXPECT_TRUE(found.at(60, y)) << y;
    EXPECT_FALSE(found.at(55, y) || found.at(65, y)) << y;
  }
  EXPECT_EQ(clearPaper(pale.ink, pale.grey, evenPaper(), kPenPx, {}).count(), 0);
}

TEST(ClearPaper, IsNoGrain) {
  const FineInk page = fineInkOf([](double x, double y) {
    const bool isHole = static_cast<int>(x) % 5 == 0 && static_cast<int>(y + 2.0 * x) % 7 == 0;
    return isHole ? 0.13 : 1.0;
  });
  ASSERT_EQ(page.ink.count(), std::int64_t{kFineSide} * kFineSide);
  EXPECT_EQ(clearPaper(page.ink, page.grey, evenPaper(), kPenPx, {}).count(), 0);
}

}  // namespace
}  // namespace batten
