// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/ruling_stretches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace batten {
namespace {

/// Grainy paper with ruled lines that run down, a little turned, some of them up to the border.
Plane ruledPaper(int width, int height, double slope, unsigned seed) {
  std::mt19937 random(seed);
  Plane paper(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double away = std::remainder(x + slope * y, 17.0);
      const double ink = std::max(0.0, 1.0 - std::fabs(away)) * 40.0;
      paper.row(y)[x] = static_cast<float>(230.0 - ink) - static_cast<float>(random() % 64) / 16.0f;
    }
  }
  return paper;
}

Plane mirrored(const Plane& in) {
  Plane out(in.height, in.width);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) out.row(x)[y] = in.row(y)[x];
  return out;
}

void expectSame(const RulingStretches& a, const RulingStretches& b) {
  EXPECT_EQ(a.slope, b.slope);
  EXPECT_EQ(a.stripWidth, b.stripWidth);
  ASSERT_EQ(a.strips.size(), b.strips.size());
  ASSERT_EQ(a.fans.size(), b.fans.size());
  for (std::size_t s = 0; s < a.strips.size(); ++s) {
    EXPECT_EQ(a.fans[s].slope, b.fans[s].slope);
    EXPECT_EQ(a.fans[s].fan, b.fans[s].fan);
    ASSERT_EQ(a.strips[s].size(), b.strips[s].size());
    for (std::size_t i = 0; i < a.strips[s].size(); ++i) {
      EXPECT_EQ(a.strips[s][i].place, b.strips[s][i].place);
      EXPECT_EQ(a.strips[s][i].inked, b.strips[s][i].inked);
    }
  }
}

TEST(RulingStretches, OfAMirroredViewAreThoseOfTheMirroredPlane) {
  for (const auto& [width, height] : {std::pair{240, 301}, {333, 190}, {160, 160}, {167, 420}}) {
    for (const double slope : {0.0, 0.04, -0.13}) {
      const Plane paper = ruledPaper(width, height, slope, 5);
      RunContext alone;
      alone.threads = 1;
      const RulingStretches plain = findRulingStretches({mirrored(paper), false}, alone);
      std::size_t lines = 0;
      for (const auto& strip : plain.strips) lines += strip.size();
      EXPECT_GE(lines, 40u);
      for (const RunContext& context : {RunContext{}, alone})
        expectSame(findRulingStretches({paper, true}, context), plain);
    }
  }
}

}  // namespace
}  // namespace batten
