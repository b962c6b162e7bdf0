// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/bits/run_pieces.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/run_differences.h"
#include "tests/unit/image/random_image.h"

namespace batten {
namespace {

/// Calls `visit` with the pixels of every connected piece of value `ink`, by flood fill.
void floodPieces(const BitImage& image, bool ink, int neighbours,
                 const std::function<void(const std::vector<std::pair<int, int>>&)>& visit) {
  static constexpr int kDx[] = {1, -1, 0, 0, 1, 1, -1, -1}, kDy[] = {0, 0, 1, -1, 1, -1, 1, -1};
  BitImage seen(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (seen.at(x, y) || image.at(x, y) != ink) continue;
      std::vector<std::pair<int, int>> piece{{x, y}};
      seen.set(x, y, true);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        for (int k = 0; k < neighbours; ++k) {
          const int u = piece[i].first + kDx[k], v = piece[i].second + kDy[k];
          if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
          if (seen.at(u, v) || image.at(u, v) != ink) continue;
          seen.set(u, v, true);
          piece.emplace_back(u, v);
        }
      }
      visit(piece);
    }
  }
}

TEST(RunPieces, KeepsWhatFloodFillKeeps) {
  for (const double density : {0.1, 0.3, 0.4, 0.6}) {
    for (const int width : {64, 65, 131}) {
      const BitImage image = test::randomImage(width, 600, density, 5);
      const BitImage seeds = test::randomImage(width, 600, 0.05, 6);
      BitImage expected(width, 600);
      floodPieces(image, true, 8, [&](const auto& piece) {
        bool seeded = false;
        for (const auto& [x, y] : piece) seeded = seeded || seeds.at(x, y);
        if (!seeded || piece.size() < 7) return;
        for (const auto& [x, y] : piece) expected.set(x, y, true);
      });
      RunContext context;
      context.threads = 3;
      EXPECT_EQ(keepPieces(image, {.minArea = 7, .minDiagonal = 0.0, .seeds = &seeds}, context), expected);
    }
  }
}

TEST(RunPieces, OfADifferenceAreThoseOfItsImage) {
  for (const int width : {1, 63, 64, 65, 200}) {
    const BitImage a = test::randomImage(width, 530, 0.6, 7), b = test::randomImage(width, 530, 0.4, 8);
    for (const auto connectivity : {Connectivity::Four, Connectivity::Eight}) {
      const RunPieces expected = findPieces(without(a, b), connectivity, {});
      const RunPieces found = findPiecesOfDifference(a, b, connectivity, {});
      EXPECT_EQ(found.piece, expected.piece);
      ASSERT_EQ(found.runs.size(), expected.runs.size());
      for (std::size_t i = 0; i < found.runs.size(); ++i) {
        EXPECT_EQ(found.runs[i].y, expected.runs[i].y);
        EXPECT_EQ(found.runs[i].x0, expected.runs[i].x0);
        EXPECT_EQ(found.runs[i].x1, expected.runs[i].x1);
      }
    }
  }
}

TEST(RunPieces, CopiesClearsAndCountsTheBitsOfARun) {
  const BitImage image = test::randomImage(200, 4, 0.5, 9);
  for (const batten::InkRun& run :
       std::vector<batten::InkRun>{{0, 0, 200}, {1, 3, 60}, {2, 63, 65}, {3, 64, 128}, {1, 127, 129}}) {
    BitImage copied = test::randomImage(200, 4, 0.2, 10), cleared = image;
    BitImage expected = copied, without = image;
    int count = 0;
    for (int x = run.x0; x < run.x1; ++x) {
      if (image.at(x, run.y)) expected.set(x, run.y, true);
      if (image.at(x, run.y)) ++count;
      without.set(x, run.y, false);
    }
    copyBits(image, run, copied);
    clearBits(cleared, run);
    EXPECT_EQ(copied, expected);
    EXPECT_EQ(cleared, without);
    EXPECT_EQ(countBits(image, run), count);
  }
}

TEST(RunPieces, FillsTheHolesThatFloodFillFinds) {
  for (const double density : {0.5, 0.6, 0.75, 0.95}) {
    for (const int width : {63, 64, 130}) {
      BitImage image = test::randomImage(width, 300, density, 8);
      BitImage expected = image;
      floodPieces(image, false, 4, [&](const auto& piece) {
        bool atBorder = false;
        for (const auto& [x, y] : piece) atBorder = atBorder || x == 0 || y == 0 || x == width - 1 || y == 299;
        if (atBorder || piece.size() >= 10) return;
        for (const auto& [x, y] : piece) expected.set(x, y, true);
      });
      fillHoles(image, 10, {});
      EXPECT_EQ(image, expected);
    }
  }
}

}  // namespace
}  // namespace batten
