// SPDX-License-Identifier: GPL-3.0-or-later
// How much memory a page takes at the most, byte per pixel: never several copies of it are held at once.
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace batten {
namespace {

using test::Outcome;

struct PageSize {
  int width = 0, height = 0;
  double pixels() const { return 1.0 * width * height; }
};
// Blocks of the larger page go back to the system as soon as they are freed.
constexpr PageSize kSmall{1500, 1000}, kLarge{5000, 3600};

/// What is on a page: an outline at its upper left, and over all of it lines.
struct PageKind {
  const char* name;
  Colour ink, lines;        ///< Lines of white: none.
  double mostBytes;         ///< A pixel.
  bool hasPatches = false;  ///< Patches of ink with holes, all over the page.
};

constexpr Colour kWhite{255, 255, 255};

/// Ink of 200 x 160 px with eight holes of 16 px in it, every 800 px.
void drawPatches(Picture& page, const Colour& ink) {
  constexpr int kEvery = 800, kWidth = 200, kHeight = 160, kHoleEvery = 40, kHole = 16;
  for (int y = 620; y < page.height; ++y) {
    for (int x = 20; x < page.width - 20; ++x) {
      const int u = x % kEvery, v = y % kEvery;
      if (u >= kWidth || v >= kHeight || y - v < 620 || y - v + kHeight > page.height - 20) continue;
      const bool isHole = u % kHoleEvery < kHole && v % kHoleEvery < kHole && u > kHole && v > kHole;
      if (!isHole) page.set(x, y, ink);
    }
  }
}

class PageMemory : public test::Program, public testing::WithParamInterface<PageKind> {
 protected:
  std::uint64_t peakOf(const PageSize& size) const {
    Picture page(size.width, size.height);
    if (GetParam().hasPatches) drawPatches(page, GetParam().ink);
    for (int y = 40; y < size.height && GetParam().lines != kWhite; y += 60) {
      for (int x = 0; x < size.width; ++x)
        for (int k = 0; k < 3; ++k) page.set(x, y + k < size.height ? y + k : y, GetParam().lines);
    }
    for (int y = 0; y < 600; ++y) {
      for (int x = 0; x < 900; ++x) {
        const double a = (x - 450.0) / 380.0, b = (y - 300.0) / 240.0, r = a * a + b * b;
        if (r < 1.0 && r > 0.95) page.set(x, y, GetParam().ink);
      }
    }
    write("page.png", encodePng(page).value());
    const Outcome done = run("trace " + file("page.png") + " --dpi 300 --threads 1 -o " + file("o.svg"));
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? nlohmann::json::parse(done.out)["peak_memory_bytes"].get<std::uint64_t>() : 0;
  }
};

TEST_P(PageMemory, GrowsByFewBytesAPixel) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return;  // they hold freed memory back
#endif
  const auto small = static_cast<double>(peakOf(kSmall)), large = static_cast<double>(peakOf(kLarge));
  ASSERT_GT(small, 0.0);
  const double bytes = (large - small) / (kLarge.pixels() - kSmall.pixels());
  RecordProperty("bytes_per_pixel", std::to_string(bytes));
  std::printf("%s: %.2f bytes a pixel\n", GetParam().name, bytes);
  EXPECT_LT(bytes, GetParam().mostBytes);
  EXPECT_GT(bytes, 2.0) << "the grey page itself";
}

// What a page takes: its grey 2 bytes a pixel, its colours 3. While it is read, the decoder holds 3 more beside both;
// while coloured ink is looked for, there are three masks and the numbers of the pieces, 7 in all.
INSTANTIATE_TEST_SUITE_P(Kinds, PageMemory,
                         testing::Values(PageKind{"grey", {30, 30, 30}, {255, 255, 255}, 5.0},
                                         PageKind{"colour", {30, 40, 160}, {255, 255, 255}, 13.0},
                                         PageKind{"ruled", {30, 40, 160}, {160, 190, 230}, 12.5},
                                         PageKind{"holes", {30, 30, 30}, {255, 255, 255}, 6.0, true}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace batten
