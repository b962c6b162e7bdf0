// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "core/construct/pieces.h"

namespace batten::test {

/// Makes curves of pieces whose points lie anywhere, with stations at most of them that look anywhere: each is finite,
/// or there is none for a numerical reason. @param construct of a piece.
template <class Construct>
void expectFiniteOrError(int trials, const Construct& construct) {
  std::mt19937 random(9);
  std::normal_distribution<double> where(0.0, 40.0);
  for (int trial = 0; trial < trials; ++trial) {
    ConstructPiece piece;
    piece.closed = trial % 3 == 0;
    const auto count = random() % 12;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 p(where(random), where(random));
      piece.points.push_back({p});
      if (random() % 4 != 0) piece.stations.push_back({p, Vec2(where(random), where(random)), p, p});
    }
    const auto made = construct(piece);
    if (!made) {
      EXPECT_EQ(made.error().code, ErrorCode::Numerical);
      continue;
    }
    for (const Vec2& p : made->curve.controlPoints()) ASSERT_TRUE(p.allFinite());
  }
}

}  // namespace batten::test
