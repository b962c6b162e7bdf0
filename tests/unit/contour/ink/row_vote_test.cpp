// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/row_vote.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/image/bits/bit_steps.h"

namespace batten {
namespace {

/// An upright bar, or one of a row of letters.
struct Bar {
  int x, y, width, height;
  bool isShape;
  bool isPencil = false;
  bool isLabelledShape = false;  ///< Of pencil: what labelInk() says.
};

/// Bars on paper, voted on.
class Bars {
 public:
  explicit Bars(const std::vector<Bar>& bars)
      : bars_(bars), strokes_(1200, 800), shapes_(1200, 800), labelled_(1200, 800), pencil_(1200, 800) {
    for (const Bar& bar : bars_) draw(bar);
    const RunPieces pieces = findPieces(either(strokes_, shapes_), Connectivity::Eight, {});
    voteInRows({pieces, paths_, labelled_, &pencil_}, strokes_, shapes_, {});
  }
  /// Of the ink of a bar; absent: some of it is of either kind.
  std::optional<bool> isShape(int i) const {
    std::int64_t shapes = 0, all = 0;
    for (int y = bars_[i].y; y < bars_[i].y + bars_[i].height; ++y) {
      const InkRun run{y, bars_[i].x, bars_[i].x + bars_[i].width};
      shapes += countBits(shapes_, run);
      all += countBits(strokes_, run) + countBits(shapes_, run);
    }
    EXPECT_EQ(all, bars_[i].width * bars_[i].height);
    return shapes == 0 || shapes == all ? std::optional(shapes == all) : std::nullopt;
  }
  int shapes() const {
    int count = 0;
    for (int i = 0; i < std::ssize(bars_); ++i) count += isShape(i) == true ? 1 : 0;
    return count;
  }

 private:
  void draw(const Bar& bar) {
    for (int y = bar.y; y < bar.y + bar.height; ++y) {
      const InkRun run{y, bar.x, bar.x + bar.width};
      setBits(bar.isShape ? shapes_ : strokes_, run);
      if (bar.isPencil) setBits(pencil_, run);
      if (bar.isPencil ? bar.isLabelledShape : bar.isShape) setBits(labelled_, run);
    }
    StrokePath path;
    const bool isUpright = bar.height > bar.width;
    const float radius = 0.5f * static_cast<float>(std::min(bar.width, bar.height));
    for (int k = 0; k <= std::max(bar.width, bar.height); ++k) {
      const Vec2 middle(bar.x + 0.5 * bar.width, bar.y + 0.5 * bar.height);
      path.points.push_back({isUpright ? Vec2(middle.x(), bar.y + k) : Vec2(bar.x + k, middle.y()), radius});
    }
    paths_.push_back(std::move(path));
  }

  std::vector<Bar> bars_;
  BitImage strokes_, shapes_, labelled_, pencil_;
  std::vector<StrokePath> paths_;
};

/// Bars of 10 x 60 px side by side, those counted as shapes first.
std::vector<Bar> row(int count, int shapes, int stepPx = 40) {
  std::vector<Bar> bars;
  for (int i = 0; i < count; ++i) bars.push_back({60 + stepPx * i, 100 + 5 * (i % 2), 10, 60, i < shapes});
  return bars;
}

TEST(RowVote, MostOfARowDecide) {
  EXPECT_EQ(Bars(row(7, 2)).shapes(), 0);
  EXPECT_EQ(Bars(row(7, 5)).shapes(), 7);
}

TEST(RowVote, TwoLongOnesDoNotOverruleThree) {
  std::vector<Bar> bars;
  for (int i = 0; i < 5; ++i) bars.push_back({60 + 40 * i, 100, 10, i < 3 ? 35 : 70, i < 3});
  EXPECT_EQ(Bars(bars).shapes(), 3);
  bars.push_back({260, 100, 10, 70, false});
  EXPECT_EQ(Bars(bars).shapes(), 0);
}

TEST(RowVote, LyingBarsAboveOneAnotherAreARow) {
  std::vector<Bar> bars;
  for (int i = 0; i < 5; ++i) bars.push_back({100, 100 + 40 * i, 60, 10, i == 3});
  EXPECT_EQ(Bars(bars).shapes(), 0);
}

TEST(RowVote, TwoAreNoRow) { EXPECT_EQ(Bars(row(2, 1)).shapes(), 1); }

TEST(RowVote, BarsFartherApartThanTheyAreHighAreNoRow) { EXPECT_EQ(Bars(row(7, 2, 80)).shapes(), 2); }

TEST(RowVote, WhatIsClearlyWiderOrHigherIsOfNoRow) {
  std::vector<Bar> bars = row(6, 0);
  bars.push_back({60 + 40 * 6, 100, 18, 60, true});
  bars.push_back({20, 60, 10, 140, true});
  const Bars voted(bars);
  EXPECT_EQ(voted.isShape(6), true);
  EXPECT_EQ(voted.isShape(7), true);
  EXPECT_EQ(voted.shapes(), 2);
}

// A brush that ran dry in some letters looks like a pencil there.
TEST(RowVote, GrainInSomeLettersOfABrushIsOfTheBrush) {
  std::vector<Bar> bars = row(7, 4);
  for (int i = 4; i < 7; ++i) bars[i].isPencil = bars[i].isLabelledShape = true;
  EXPECT_EQ(Bars(bars).shapes(), 7);
}

// The widths of a pencil vary by its grain, and labelInk() takes that for a nib.
TEST(RowVote, GrainInMostLettersIsAPencil) {
  std::vector<Bar> bars = row(7, 2);
  for (int i = 2; i < 7; ++i) bars[i].isPencil = bars[i].isLabelledShape = true;
  EXPECT_EQ(Bars(bars).shapes(), 0);
}

}  // namespace
}  // namespace batten
