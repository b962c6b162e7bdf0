// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;

constexpr int kDiscWidth = 360, kDiscHeight = 220;

// A black disc with a white eye, two lines of 5 px that run into it, and a dash of 26 px.
std::string discWithLines() {
  std::string pixels(std::ptrdiff_t{kDiscWidth} * kDiscHeight, '\xff');
  for (int y = 0; y < kDiscHeight; ++y) {
    for (int x = 0; x < kDiscWidth; ++x) {
      const double r = std::hypot(x - 100, y - 100);
      const bool isInk = (r < 50.0 && r > 12.0) || (std::abs(y - 100) <= 2 && x > 145 && x < 340) ||
                         (std::abs(x - 100) <= 2 && y > 145 && y < 210) ||
                         (std::abs(y - 30) <= 2 && x > 250 && x < 277);
      if (isInk) pixels[y * kDiscWidth + x] = '\x10';
    }
  }
  return "P5\n360 220\n255\n" + pixels;
}

class Regions : public test::Program {
 protected:
  json trace(const std::string& words) {
    write("disc.pgm", discWithLines());
    const auto done = run("trace " + file("disc.pgm") + " --dpi 254 " + words + " -o " + file("o.json") + " --report " +
                          file("r.json"));
    EXPECT_EQ(done.code, 0) << done.err;
    notes = json::parse(done.out)["notes"].dump();
    return json::parse(test::readFile(file("r.json")))["contours"];
  }
  static int count(const json& contours, const std::string& kind) {
    int n = 0;
    for (const json& c : contours) n += c["kind"] == kind ? 1 : 0;
    return n;
  }
  std::string notes;
};

TEST_F(Regions, AreFollowedEachInItsWay) {
  const json contours = trace("");
  EXPECT_EQ(count(contours, "outline"), 2) << "the disc and its eye";
  EXPECT_EQ(count(contours, "centreline"), 3) << "both lines and the dash";
}

TEST_F(Regions, AreTurnedOneByOne) {
  const json border = trace("--outline 250,100");
  EXPECT_EQ(count(border, "centreline"), 2) << "the other line and the dash stay";
  EXPECT_EQ(count(border, "outline"), 2) << "disc and line have one border";
  const json middle = trace("--centreline 250,100");
  EXPECT_EQ(count(middle, "centreline"), 3) << "it is a stroke already";
  const json none = trace("--outline 330,200");
  EXPECT_EQ(count(none, "centreline"), 3);
  EXPECT_NE(notes.find("there is no ink"), std::string::npos) << notes;
}

TEST_F(Regions, KeepTheirChoiceWhenAThresholdMoves) {
  for (const char* strength : {"0.7", "1", "1.3"}) {
    const json contours = trace(std::string("--outline 250,100 --set threshold.strength=") + strength);
    EXPECT_EQ(count(contours, "centreline"), 2) << strength;
    EXPECT_EQ(count(contours, "outline"), 2) << strength;
  }
}

TEST_F(Regions, HolesAreLeftOutOnRequestInOldWordsToo) {
  for (const char* word : {"off", "false"}) {
    EXPECT_EQ(count(trace(std::string("--set edges.internal=") + word), "outline"), 1) << word;
  }
  EXPECT_EQ(count(trace("--set edges.mode=outline"), "outline"), 2) << "disc with its lines, and the dash";
  EXPECT_EQ(count(trace("--set edges.mode=outline --set edges.internal=true"), "outline"), 3);
}

TEST_F(Regions, ShortLinesGoByWidthsOrByPixelsAndAreTold) {
  EXPECT_EQ(trace("--set contours.min_widths=6").size(), 4u);
  EXPECT_NE(notes.find("short line was dropped"), std::string::npos) << notes;
  EXPECT_EQ(trace("--set contours.min_length=40").size(), 4u);
  EXPECT_EQ(trace("--set contours.max_count=2").size(), 2u);
  EXPECT_NE(notes.find("2 longest of 5"), std::string::npos) << notes;
}

TEST_F(Regions, RecipesOfOlderVersionsLoad) {
  write("old.json",
        R"({"format":"batten-recipe","version":1,"parameters":{"edges.internal":false,"edges.stroke_width":0.03,)"
        R"("contours.min_length":40,"contours.max_count":400}})");
  const json contours = trace("--recipe " + file("old.json"));
  EXPECT_EQ(contours.size(), 3u) << "neither the eye nor the dash";
  EXPECT_NE(notes.find("edges.stroke_width has no effect"), std::string::npos) << notes;
}

}  // namespace
}  // namespace batten
