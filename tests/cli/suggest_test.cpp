// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/support/overdrawn_page.h"
#include "tests/support/render_page.h"

namespace batten {
namespace {

using nlohmann::json;

class Suggest : public test::Program {
 protected:
  std::string page(int strokes) const {
    const test::IntendedLine line = test::cubicLine({60, 500}, {420, 560}, {200, 80}, {580, 120});
    std::vector<test::PenPath> drawn;
    for (int k = 0; k < strokes; ++k)
      drawn.push_back(test::wanderAlong(line, 0.0, 1.0, 10.0, 101 + static_cast<unsigned>(k)));
    write("page.png", pngOf(test::overdrawnScan(drawn).grey));
    return file("page.png");
  }
};

TEST_F(Suggest, AStrengthThatMakesOneLineOfABundle) {
  const std::string scan = page(3);
  const auto done = run("suggest " + scan);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  const json said = json::parse(done.out);
  const double strength = said["edges.merge"];
  EXPECT_GT(strength, 0.0);
  EXPECT_GT(said["strokes"].get<int>(), 1);
  EXPECT_EQ(said["lines"], 1);
  EXPECT_EQ(said["edges.intent"], true);
  const auto meant = run("trace " + scan + " --set edges.intent=on -o " + file("meant.json"));
  ASSERT_EQ(meant.code, 0) << meant.err;
  EXPECT_EQ(json::parse(meant.out)["curves"], said["curves_meant"]);
  EXPECT_NE(said["reason"].get<std::string>().find("strokes become 1 line."), std::string::npos);
  const auto traced =
      run("trace " + scan + " --set edges.merge=" + std::to_string(strength) + " -o " + file("lines.json"));
  ASSERT_EQ(traced.code, 0) << traced.err;
  EXPECT_EQ(json::parse(traced.out)["curves"], 1);
  EXPECT_EQ(json::parse(run("suggest " + scan + " --threads 1").out), said);
}

TEST_F(Suggest, NoneForASingleStroke) {
  const auto done = run("suggest " + page(1));
  ASSERT_EQ(done.code, 0) << done.err;
  const json said = json::parse(done.out);
  EXPECT_EQ(said["edges.merge"], 0.0);
  EXPECT_EQ(said["lines"], said["strokes"]);
  EXPECT_EQ(said["edges.intent"], false);
  EXPECT_TRUE(said["curves_meant"].is_null());
  EXPECT_TRUE(said["corners"].empty());
  EXPECT_NE(said["reason"].get<std::string>().find("No overdrawn strokes"), std::string::npos);
}

TEST_F(Suggest, CornersWithAngleAndCertainty) {
  const auto shape = test::truthShape("K", 500, 400);
  const auto coverage = test::fillCoverage(shape.outline(), 500, 400);
  write("k.png", pngOf(test::renderPage(coverage, 500, 400, test::cleanPage()).grey));
  const auto done = run("suggest " + file("k.png"));
  ASSERT_EQ(done.code, 0) << done.err;
  int certain = 0;
  const json said = json::parse(done.out);
  for (const json& corner : said["corners"]) {
    const Vec2 at(corner["at"][0], corner["at"][1]);
    double nearest = 1e9;
    for (const Vec2& truth : shape.corners) nearest = std::min(nearest, (truth - at).norm());
    EXPECT_LT(nearest, 1.0) << corner;
    EXPECT_GT(corner["angle"].get<double>(), 25.0);
    EXPECT_LT(corner["angle"].get<double>(), 180.0);
    EXPECT_EQ(corner["certain"].get<bool>(), corner["certainty"].get<double>() >= 0.95);
    certain += corner["certain"].get<bool>() ? 1 : 0;
  }
  EXPECT_GE(certain, 10);  // of 11
  const auto traced = run("trace " + file("k.png") + " --dpi 300 -o " + file("k.json"));
  ASSERT_EQ(traced.code, 0) << traced.err;
  EXPECT_EQ(json::parse(traced.out)["corners_without_mark"], certain);
  const auto off = run("trace " + file("k.png") + " --dpi 300 --set corners.auto=false -o " + file("off.json"));
  ASSERT_EQ(off.code, 0) << off.err;
  EXPECT_EQ(json::parse(off.out)["corners_without_mark"], 0);
  EXPECT_EQ(json::parse(off.out)["pieces"], 1);
}

TEST_F(Suggest, SaysWhatIsWrong) {
  expectError("suggest", 2, "scan");
  expectError("suggest -o x " + file("none.png"), 2,
              "suggest has no option -o: it prints its advice and writes no file. Run batten-cli suggest --help.");
  expectError("suggest a.png b.png", 2, "\"b.png\" is an unexpected argument of suggest.");
  expectError("suggest " + file("none.png"), 3, "none.png");
  expectError("suggest " + page(1) + " --set edges.merge=99", 2, "edges.merge");
  expectError("suggest " + page(0), 4, "line");
}

// A stem of 5 px that forks evenly at (200, 100): black on white.
std::string fork() {
  constexpr int kForkWidth = 400, kForkHeight = 200;
  std::string pixels(std::ptrdiff_t{kForkWidth} * kForkHeight, '\xff');
  for (int y = 0; y < kForkHeight; ++y) {
    for (int x = 20; x < 380; ++x) {
      const double aside = x < 200 ? 0.0 : 0.2 * (x - 200);
      if (std::min(std::abs(y - 100 - aside), std::abs(y - 100 + aside)) <= 2.5) pixels[y * kForkWidth + x] = '\x10';
    }
  }
  return "P5\n400 200\n255\n" + pixels;
}

TEST_F(Suggest, DoubtfulJunctionsAndTheirNextBestWay) {
  write("fork.pgm", fork());
  const auto done = run("suggest " + file("fork.pgm"));
  ASSERT_EQ(done.code, 0) << done.err;
  const json junctions = json::parse(done.out)["doubtful_junctions"];
  ASSERT_EQ(junctions.size(), 1u);
  const json& one = junctions[0];
  EXPECT_NEAR(one["at"][0].get<double>(), 207.0, 12.0);
  ASSERT_EQ(one["branches"].size(), 3u);
  ASSERT_EQ(one["pairs"].size(), 1u);
  ASSERT_EQ(one["next_best"].size(), 1u);
  EXPECT_NE(one["pairs"], one["next_best"]);

  // The tine at which the stroke from the stem arrives.
  const auto arrivesBelow = [&](const std::string& words) {
    const auto traced = run("trace " + file("fork.pgm") + " --dpi 254 " + words + " -o " + file("o.json") +
                            " --save-recipe " + file("recipe.json"));
    EXPECT_EQ(traced.code, 0) << traced.err;
    EXPECT_EQ(json::parse(traced.out)["doubtful_junctions"], words.empty() ? 1 : 0);
    const json curves = json::parse(test::readFile(file("o.json")))["curves"];
    EXPECT_EQ(curves.size(), 2u);
    for (const json& curve : curves) {
      double left = 400.0, right = 0.0, y = 0.0;
      for (const json& piece : curve["pieces"]) {
        for (const json& p : piece["control_points_px"]) {
          left = std::min(left, p[0].get<double>());
          if (p[0].get<double>() > right) right = p[0].get<double>(), y = p[1].get<double>();
        }
      }
      if (left < 40.0) return y > 100.0;
    }
    ADD_FAILURE() << "no curve follows the stem";
    return false;
  };
  const bool plain = arrivesBelow("");
  const auto place = [&](const json& at) { return at[0].dump() + "," + at[1].dump(); };
  const json& next = one["next_best"][0];
  const std::string pair = "--pair " + place(one["at"]) + "," + place(one["branches"][next[0].get<std::size_t>()]) +
                           "," + place(one["branches"][next[1].get<std::size_t>()]);
  EXPECT_NE(arrivesBelow(pair), plain);
  EXPECT_NE(arrivesBelow("--recipe " + file("recipe.json")), plain) << "the recipe holds it";
  const auto open = run("trace " + file("fork.pgm") + " --pair " + place(one["at"]) + " -o " + file("o.json"));
  EXPECT_EQ(json::parse(open.out)["curves"], 3) << "all strokes end there";
  expectError("trace " + file("fork.pgm") + " --pair 1,2,3,4 -o " + file("o.json"), 2, "--pair takes X,Y");
  expectError("trace " + file("fork.pgm") + " --pair here -o " + file("o.json"), 2, "--pair takes X,Y");
}

}  // namespace
}  // namespace batten
