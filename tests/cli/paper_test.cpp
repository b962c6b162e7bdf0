// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/image/bits/bit_image.h"
#include "tests/cli/program.h"
#include "tests/support/colour_page.h"

namespace batten {
namespace {

using test::InkLayer;
using test::lineCoverage;

constexpr int kSheetWidth = 420, kSheetHeight = 360;

class Paper : public test::Program {
 protected:
  /// A colour page as NAME.png in the folder.
  std::string colourPage(const std::string& name, const std::vector<InkLayer>& inks) const {
    test::ColourPage page;
    page.width = kSheetWidth;
    page.height = kSheetHeight;
    page.noise = 1.5;
    const Scan scan = test::renderColourPage(page, inks);
    Picture picture(kSheetWidth, kSheetHeight);
    for (int y = 0; y < kSheetHeight; ++y) {
      for (int x = 0; x < kSheetWidth; ++x) {
        const Rgb8& c = scan.colour.row(y)[x];
        picture.set(x, y, {c.red, c.green, c.blue});
      }
    }
    write(name, encodePng(picture).value());
    return file(name);
  }
  nlohmann::json traced(const std::string& scan, const std::string& more = {}) const {
    const auto done = run("trace " + scan + " --dpi 300 -o " + file("out.json") + " " + more);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? nlohmann::json::parse(done.out) : nlohmann::json();
  }
};

InkLayer line(const Vec2& a, const Vec2& b, double widthPx, const std::array<double, 3>& passes) {
  return {lineCoverage(kSheetWidth, kSheetHeight, a, b, widthPx), passes};
}

InkLayer rules() {
  InkLayer layer{std::vector<float>(std::ptrdiff_t{kSheetWidth} * kSheetHeight, 0.0f), {0.72, 0.8, 0.9}};
  for (int y = 0; y < kSheetHeight; ++y) {
    if (y % 24 != 11) continue;
    for (int x = 0; x < kSheetWidth; ++x) layer.coverage[std::ptrdiff_t{y} * kSheetWidth + x] = 1.0f;
  }
  return layer;
}

TEST_F(Paper, YellowMarkerIsTracedUnlessBrightnessIsAskedFor) {
  const std::string scan = colourPage("marker.png", {line({50, 60}, {370, 130}, 9, {0.99, 0.95, 0.35}),
                                                     line({50, 280}, {370, 240}, 5, {0.1, 0.1, 0.1})});
  EXPECT_EQ(traced(scan).at("curves"), 2);
  EXPECT_EQ(traced(scan, "--set paper.colour=grey").at("curves"), 1);
}

TEST_F(Paper, RuledLinesAreLeftOutAndBroughtBack) {
  const std::string scan = colourPage("ruled.png", {rules(), line({60, 40}, {360, 320}, 5, {0.1, 0.1, 0.1})});
  const nlohmann::json without = traced(scan);
  EXPECT_EQ(without.at("curves"), 1);
  ASSERT_FALSE(without.at("notes").empty());
  EXPECT_NE(without.at("notes").dump().find("15 ruled lines across the page were removed"), std::string::npos)
      << without.at("notes");
  const nlohmann::json with = traced(scan, "--set paper.rulings=keep");
  EXPECT_GT(with.at("curves").get<int>(), 10);
  EXPECT_EQ(with.at("notes").dump().find("ruled lines"), std::string::npos);
}

TEST_F(Paper, InksAreDroppedAndKeptByName) {
  const std::string scan = colourPage(
      "inks.png", {line({40, 60}, {380, 90}, 4, {0.85, 0.25, 0.3}), line({40, 180}, {380, 200}, 4, {0.3, 0.4, 0.85}),
                   line({40, 300}, {380, 280}, 4, {0.1, 0.1, 0.1})});
  EXPECT_EQ(traced(scan).at("curves"), 3);
  EXPECT_EQ(traced(scan, "--set inks.drop=blue").at("curves"), 2);
  EXPECT_EQ(traced(scan, "--set inks.drop=blue,black").at("curves"), 1);
  EXPECT_EQ(traced(scan, "--set inks.keep=red").at("curves"), 1);
  expectError("trace " + scan + " --set inks.drop=beige -o " + file("out.json"), 2, "inks.drop cannot be \"beige\"");
}

}  // namespace
}  // namespace batten
