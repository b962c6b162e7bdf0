// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/ink_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace batten {
namespace {

/// Even paper with blots, each of one grey and with a rim of one pixel half as deep: paper without noise or slope, so
/// that all 64 regions have the least noise and no slope of their own.
Plane blottedPaper(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
  Plane u(width, height);
  std::fill_n(u.row(0), static_cast<std::ptrdiff_t>(width) * height, 220.0f);
  for (int blot = 0; blot < 24; ++blot) {
    const int x0 = below(width), y0 = below(height), w = 2 + below(7), h = 2 + below(7);
    const auto depth = 0.25f * static_cast<float>(1 + below(300));
    for (int y = std::max(0, y0 - 1); y < std::min(height, y0 + h + 1); ++y) {
      for (int x = std::max(0, x0 - 1); x < std::min(width, x0 + w + 1); ++x) {
        const bool isRim = x < x0 || y < y0 || x >= x0 + w || y >= y0 + h;
        u.row(y)[x] = std::min(u.row(y)[x], 220.0f - (isRim ? 0.5f : 1.0f) * depth);
      }
    }
  }
  return u;
}

/// All from the definition, pixel by pixel on whole pictures.
struct PlainEdges {
  int width, height;
  std::vector<float> squares;
  std::vector<bool> area;

  explicit PlainEdges(const Plane& u)
      : width(u.width),
        height(u.height),
        squares(std::ptrdiff_t{width} * height, 0.0f),
        area(std::ptrdiff_t{width} * height, false) {
    for (int y = 1; y + 1 < height; ++y) {
      for (int x = 1; x + 1 < width; ++x) {
        const float gx = 0.5f * (u.row(y)[x + 1] - u.row(y)[x - 1]), gy = 0.5f * (u.row(y + 1)[x] - u.row(y - 1)[x]);
        squares[at(x, y)] = gx * gx + gy * gy;
      }
    }
    const float floor = 0.06f * strong() / 6.0f;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (isSteep(x, y, 6.0f, floor)) flood(x, y, floor);
  }

  std::ptrdiff_t at(int x, int y) const { return std::ptrdiff_t{y} * width + x; }
  bool isSteep(int x, int y, float factor, float floor) const {
    const float limit = factor * std::max(kNoise, floor);
    return squares[at(x, y)] > limit * limit;
  }
  bool isCrest(const Plane& u, int x, int y) const {
    if (!area[at(x, y)] || x < 1 || y < 1 || x + 1 >= width || y + 1 >= height) return false;
    const float gx = u.row(y)[x + 1] - u.row(y)[x - 1], gy = u.row(y + 1)[x] - u.row(y - 1)[x];
    const bool isUpright = std::fabs(gy) > 2.4142f * std::fabs(gx), isLevel = std::fabs(gy) <= 0.4142f * std::fabs(gx);
    const int dx = isUpright ? 0 : 1, dy = isUpright ? 1 : isLevel ? 0 : (gx > 0) == (gy > 0) ? 1 : -1;
    return squares[at(x, y)] >= squares[at(x + dx, y + dy)] && squares[at(x, y)] > squares[at(x - dx, y - dy)];
  }

 private:
  static constexpr float kNoise = 0.15f;  // the least of a region

  /// The middle of the first bin of 1/8 grey up to which 98 % of the certain gradients lie.
  float strong() const {
    std::vector<int> bins;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (isSteep(x, y, 6.0f, 0.0f)) bins.push_back(static_cast<int>(8.0f * std::sqrt(squares[at(x, y)])));
    if (bins.empty()) return 0.0f;
    std::sort(bins.begin(), bins.end());
    const std::size_t needed = (bins.size() * 49 + 49) / 50;
    return (static_cast<float>(bins[needed - 1]) + 0.5f) / 8.0f;
  }

  void flood(int x, int y, float floor) {
    std::vector<std::pair<int, int>> open{{x, y}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (i < 0 || j < 0 || i >= width || j >= height || area[at(i, j)] || !isSteep(i, j, 3.0f, floor)) continue;
      area[at(i, j)] = true;
      for (int v = -1; v <= 1; ++v)
        for (int w = -1; w <= 1; ++w) open.emplace_back(i + v, j + w);
    }
  }
};

TEST(InkEdges, AreThoseOfTheDefinition) {
  for (const auto& [width, height] : {std::pair{400, 330}, {331, 457}, {290, 700}}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const Plane u = blottedPaper(width, height, seed);
      const PlainEdges plain(u);
      RunContext alone;
      alone.threads = 1;
      for (const RunContext& context : {RunContext{}, alone}) {
        const InkEdges edges = findInkEdges(u, context);
        std::size_t next = 0;
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            ASSERT_EQ(edges.area.at(x, y), plain.area[plain.at(x, y)]) << x << " " << y << " seed " << seed;
            if (!plain.isCrest(u, x, y)) continue;
            ASSERT_LT(next, edges.crests.size());
            EXPECT_EQ(edges.crests[next].x, x);
            EXPECT_EQ(edges.crests[next].y, y);
            EXPECT_EQ(edges.crests[next].strength, std::sqrt(plain.squares[plain.at(x, y)]));
            ++next;
          }
        }
        EXPECT_EQ(next, edges.crests.size());
      }
    }
  }
}

}  // namespace
}  // namespace batten
