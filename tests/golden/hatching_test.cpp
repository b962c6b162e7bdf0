// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/hatching_page.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "core/pipeline/run/pipeline.h"

/// \file
/// Hatching and nets that fill a page: every line comes, or the borders of the ink do and a note says so.

namespace batten {
namespace {

ContourSet tracedHatching(GreyImage page) {
  Scan scan;
  scan.grey = std::move(page);
  StageCache cache;
  PipelineRequest request;
  request.upTo = StageId::Contours;
  request.needEdges = false;
  const PipelineOutput out = runPipeline(scan, {}, cache, request, {});
  EXPECT_TRUE(out.contours) << (out.error ? out.error->message : "");
  return out.contours ? *out.contours : ContourSet{};
}

std::string nameOf(const test::Hatching& h) {
  return std::to_string(h.angleDeg) + " degrees, " + std::to_string(h.widthPx) + " px every " +
         std::to_string(h.spacingPx) + " px from " + std::to_string(h.offsetPx);
}

TEST(Hatching, IsTracedLineByLine) {
  const test::Hatching cases[] = {{.angleDeg = 90.0, .spacingPx = 4.0, .offsetPx = 0.5},
                                  {.angleDeg = 0.0, .spacingPx = 4.0},
                                  {.angleDeg = 0.0, .spacingPx = 3.5, .offsetPx = 0.3},
                                  {.angleDeg = 90.0, .spacingPx = 4.5, .offsetPx = 0.25},
                                  {.angleDeg = 45.0, .spacingPx = 4.2426},
                                  {.angleDeg = 45.0, .spacingPx = 4.2426, .offsetPx = 0.7, .blurPx = 0.5},
                                  {.angleDeg = -8.2, .spacingPx = 6.3},
                                  {.angleDeg = 135.0, .widthPx = 3.3, .spacingPx = 9.0}};
  for (const test::Hatching& h : cases) {
    const int drawn = test::linesOnPage(h, 3.0 * h.widthPx);
    EXPECT_NEAR(std::ssize(tracedHatching(test::hatchingPage(h)).contours), drawn, 0.05 * drawn) << nameOf(h);
  }
}

/// Levels along a diagonal of the page, over and over.
template <std::size_t Count>
GreyImage diagonalPage(const std::array<int, Count>& levels) {
  GreyImage page(600, 400);
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x)
      page.row(y)[x] = static_cast<std::uint16_t>(257 * levels[(x - y + 600) % static_cast<int>(Count)]);
  }
  return page;
}

// Between the pixels of so sharp lines grey changes as if they had grain.
TEST(Hatching, SharpObliqueLinesAreAPens) {
  const ContourSet set = tracedHatching(diagonalPage<6>({210, 20, 20, 20, 210, 235}));
  EXPECT_NEAR(std::ssize(set.contours), 164, 5);
  for (const Contour& c : set.contours) EXPECT_FALSE(c.pencilPx);
}

// Lines both ways, 5.7 px apart: each mesh is too short to be kept, together they are a quarter of the page.
TEST(Hatching, ANetWhoseMeshesAreShortIsTracedByItsBorders) {
  constexpr std::array<std::array<int, 8>, 3> kRows{
      {{20, 20, 189, 235, 235, 235, 189, 20}, {20, 20, 20, 210, 235, 210, 20, 20}, {189, 20, 20, 20, 189, 20, 20, 20}}};
  constexpr std::array<int, 8> kRowOf{0, 1, 2, 1, 0, 1, 2, 1};
  GreyImage page(600, 400);
  for (int y = 0; y < page.height; ++y) {
    const int shift = y % 8 > 2 && y % 8 < 6 ? 4 : 0;
    for (int x = 0; x < page.width; ++x)
      page.row(y)[x] = static_cast<std::uint16_t>(257 * kRows[kRowOf[y % 8]][(x + shift) % 8]);
  }
  const ContourSet set = tracedHatching(std::move(page));
  EXPECT_GT(std::ssize(set.contours), 1000);
  EXPECT_NE(set.report.note.find("borders of their ink were traced"), std::string::npos) << set.report.note;
}

}  // namespace
}  // namespace batten
