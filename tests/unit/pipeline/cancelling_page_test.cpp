// SPDX-License-Identifier: GPL-3.0-or-later
// A page filled by one line with hundreds of corners, or with hundreds of bends and no corner: each of its long stages
// hears a cancel while it works, and none comes to its end.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/pipeline/run/pipeline.h"
#include "tests/support/dense_page.h"

namespace batten {
namespace {

constexpr int kOrder = 6;         // of the Hilbert curve: 4096 places
constexpr double kStepPx = 24.0;  // from place to place; farther than corners are looked for
constexpr double kStrokePx = 3.0;
constexpr auto kWhileItWorks = std::chrono::milliseconds(20);

/// The places of a Hilbert curve in order (Sagan, Space-Filling Curves, 1994, ch. 2).
std::vector<Vec2> hilbertCurve(int order) {
  const int size = 1 << order;
  std::vector<Vec2> line;
  for (int place = 0; place < size * size; ++place) {
    int x = 0, y = 0, rest = place;
    for (int side = 1; side < size; side *= 2, rest /= 4) {
      const int right = (rest / 2) % 2, up = (rest ^ right) % 2;
      if (up == 0) {
        if (right == 1) x = side - 1 - x, y = side - 1 - y;
        std::swap(x, y);
      }
      x += side * right;
      y += side * up;
    }
    line.emplace_back(kStepPx * (x + 1), kStepPx * (y + 1));
  }
  return line;
}

constexpr double kRowPx = 40.0;  // of waves

/// Rows of waves of two heights, one behind the other.
std::vector<Vec2> rowsOfWaves(int sizePx) {
  constexpr double kWavePx = 60.0;
  const double left = 1.5 * kRowPx, right = sizePx - left;
  std::vector<Vec2> line;
  bool forward = true;
  for (double y = left; y + kRowPx < right; y += kRowPx, forward = !forward) {
    for (double x = left; x <= right; x += 1.0) {
      const double phase = 2.0 * std::numbers::pi * (x - left) / kWavePx;
      const double height = static_cast<int>(std::floor(phase / std::numbers::pi)) % 3 == 0 ? 8.0 : 5.0;
      line.emplace_back(forward ? x : left + right - x, y + height * std::sin(phase));
    }
    for (double angle = 0.0; angle < std::numbers::pi; angle += 2.0 / kRowPx) {
      const double out = 0.5 * kRowPx * std::sin(angle);
      line.emplace_back(forward ? right + out : left - out, y + 0.5 * kRowPx * (1.0 - std::cos(angle)));
    }
  }
  return line;
}

/// The same rows, each a line of its own.
std::vector<std::vector<Vec2>> wavesApart(int sizePx) {
  std::vector<std::vector<Vec2>> lines(1);
  for (const Vec2& at : rowsOfWaves(sizePx)) {
    const bool isRow = at.x() >= 1.5 * kRowPx && at.x() <= sizePx - 1.5 * kRowPx;
    if (isRow) lines.back().push_back(at);
    if (!isRow && !lines.back().empty()) lines.emplace_back();
  }
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

Recipe asDrawn() {
  Recipe recipe;
  recipe.preparation.rulings = RulingUse::Keep;  // so many straight lines look like squared paper
  recipe.fairing.mode = FairingMode::Tolerance;
  return recipe;
}

class CancellingAPage : public testing::Test {
 protected:
  void SetUp() override {
    const int size = static_cast<int>(kStepPx * ((1 << kOrder) + 1));
    scan_ = test::scanOfLines(test::coverageOf({hilbertCurve(kOrder)}, kStrokePx, size, size), size, size, 1);
  }
  /// Cancels a moment after the stage before has been ready. What is in the cache need not be computed again.
  PipelineOutput cancelledAfter(StageId before, const Recipe& recipe = asDrawn()) {
    using Clock = std::chrono::steady_clock;
    RunContext context;
    std::optional<Clock::time_point> asked;
    std::thread other;
    PipelineRequest request;
    request.needEdges = false;
    request.stageReady = [&](StageId stage, const PipelineOutput&) {
      if (stage != before) return;
      other = std::thread([&] {
        std::this_thread::sleep_for(kWhileItWorks);
        asked = Clock::now();
        context.cancel.cancel();
      });
    };
    PipelineOutput out = runPipeline(scan_, recipe, cache_, request, context);
    const auto ended = Clock::now();
    if (other.joinable()) other.join();
    if (asked) {
      std::printf("after %s: heard after %.1f ms\n", std::string(name(before)).c_str(),
                  std::chrono::duration<double, std::milli>(ended - *asked).count());
    }
    return out;
  }
  static void expectCancelled(const PipelineOutput& out) {
    ASSERT_TRUE(out.error);
    EXPECT_EQ(out.error->code, ErrorCode::Cancelled) << out.error->message;
  }

  Scan scan_;
  StageCache cache_;
};

TEST_F(CancellingAPage, IsHeardInEveryLongStage) {
  const PipelineOutput tracing = cancelledAfter(StageId::Filtered);
  expectCancelled(tracing);
  EXPECT_EQ(tracing.contours, nullptr);
  const PipelineOutput cutting = cancelledAfter(StageId::Contours);
  expectCancelled(cutting);
  EXPECT_EQ(cutting.pieces, nullptr);
  const PipelineOutput constructing = cancelledAfter(StageId::Segments);
  expectCancelled(constructing);
  ASSERT_NE(constructing.pieces, nullptr);
  EXPECT_GT(constructing.pieces->pieces.size(), 300u) << "the page is to hold many pieces of one line";
  EXPECT_EQ(constructing.constructed, nullptr);
}

// Straight pieces take no time to fair.
TEST_F(CancellingAPage, IsHeardWhileManyPiecesAreFaired) {
  constexpr int kSizePx = 960;
  scan_ = test::scanOfLines(test::coverageOf(wavesApart(kSizePx), kStrokePx, kSizePx, kSizePx), kSizePx, kSizePx, 1);
  Recipe uncut = asDrawn();
  uncut.corners.automatic = false;
  const PipelineOutput fairing = cancelledAfter(StageId::Curves, uncut);
  expectCancelled(fairing);
  ASSERT_NE(fairing.constructed, nullptr);
  EXPECT_GT(fairing.constructed->curves.size(), 15u);
  EXPECT_EQ(fairing.faired, nullptr);
}

TEST_F(CancellingAPage, IsHeardInOneLongPiece) {
  constexpr int kSizePx = 640;
  scan_ = test::scanOfLines(test::coverageOf({rowsOfWaves(kSizePx)}, kStrokePx, kSizePx, kSizePx), kSizePx, kSizePx, 1);
  Recipe uncut = asDrawn();
  uncut.corners.automatic = false;
  const PipelineOutput constructing = cancelledAfter(StageId::Segments, uncut);
  expectCancelled(constructing);
  ASSERT_NE(constructing.pieces, nullptr);
  EXPECT_EQ(constructing.pieces->pieces.size(), 1u);
  EXPECT_EQ(constructing.constructed, nullptr);
  const PipelineOutput fairing = cancelledAfter(StageId::Curves, uncut);
  expectCancelled(fairing);
  ASSERT_NE(fairing.constructed, nullptr);
  EXPECT_GT(fairing.constructed->curves.at(0).sketchedFigures.extrema, 100) << "the piece is to have many bends";
  EXPECT_EQ(fairing.faired, nullptr);
}

}  // namespace
}  // namespace batten
