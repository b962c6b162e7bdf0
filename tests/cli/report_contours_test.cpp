// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.h"

namespace batten {
namespace {

using nlohmann::json;
using ReportContours = test::Program;

constexpr int kWidth = 320, kHeight = 200;

// White paper with black bars 5 px high.
std::string pageWithBars(std::initializer_list<std::array<int, 3>> bars) {
  std::string pixels(std::ptrdiff_t{kWidth} * kHeight, '\xff');
  for (const auto& [x0, x1, y] : bars)
    for (int row = y - 2; row <= y + 2; ++row)
      for (int x = x0; x < x1; ++x) pixels[row * kWidth + x] = '\x10';
  return "P5\n320 200\n255\n" + pixels;
}

TEST_F(ReportContours, NameWidthBridgesAndSpreadAndWhatWasNotPlaced) {
  write("gap.pgm", pageWithBars({{20, 130, 60}, {142, 300, 60}}));
  ASSERT_EQ(run("trace " + file("gap.pgm") + " --set filter.iterations=0 --dpi 254 -o " + file("o.json") +
                " --report " + file("r.json"))
                .code,
            0);
  json contours = json::parse(test::readFile(file("r.json")))["contours"];
  ASSERT_EQ(contours.size(), 1u) << "joined over the gap";
  EXPECT_EQ(contours[0]["kind"], "centreline");
  EXPECT_NEAR(contours[0]["stroke_width"]["median_px"].get<double>(), 5.0, 0.3);
  EXPECT_NEAR(contours[0]["stroke_width"]["median_mm"].get<double>(), 0.5, 0.03);
  ASSERT_EQ(contours[0]["stroke_width"]["along_px"].size(), 65u);
  EXPECT_NEAR(contours[0]["stroke_width"]["along_px"][10].get<double>(), 5.0, 0.6);
  EXPECT_NEAR(contours[0]["length_mm"].get<double>(), 28.0, 0.6);
  EXPECT_TRUE(contours[0]["area_px2"].is_null());
  EXPECT_TRUE(contours[0]["merged_half_spread"].is_null());
  ASSERT_EQ(contours[0]["bridges"].size(), 1u);
  const json& bridge = contours[0]["bridges"][0];
  const double left = std::min(bridge["from_px"][0].get<double>(), bridge["to_px"][0].get<double>());
  EXPECT_NEAR(left, 130.0, 6.0);
  EXPECT_NEAR(bridge["length_px"].get<double>(), 12.0, 8.0);
  // No ink, no edge: the bridge is what was not placed.
  bool named = false;
  for (const json& s : contours[0]["not_placed"]) {
    const double a = s["from_px"][0].get<double>(), b = s["to_px"][0].get<double>();
    named = named || (std::min(a, b) < 136.0 && std::max(a, b) > 136.0);
  }
  EXPECT_TRUE(named);
}

TEST_F(ReportContours, TellHowFarMergedStrokesLayApart) {
  write("two.pgm", pageWithBars({{20, 220, 80}, {120, 300, 92}}));
  ASSERT_EQ(
      run("trace " + file("two.pgm") + " --set edges.merge=3 -o " + file("o.json") + " --report " + file("r.json"))
          .code,
      0);
  const json contours = json::parse(test::readFile(file("r.json")))["contours"];
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_NEAR(contours[0]["merged_half_spread"]["largest_px"].get<double>(), 6.0, 1.0);
}

TEST_F(ReportContours, ACurveIsNumberedFromOneAndKeepsItsNumberWhereItsPlacesInTheListsChange) {
  write("two.pgm", pageWithBars({{20, 220, 50}, {80, 300, 150}}));
  ASSERT_EQ(run("trace " + file("two.pgm") + " --set edges.mode=centreline -o " + file("o.json") + " --report " +
                file("r.json") + " --save-recipe " + file("kept.json"))
                .code,
            0);
  const json curves = json::parse(test::readFile(file("r.json")))["curves"];
  ASSERT_EQ(curves.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(curves[i]["index"], i);
    EXPECT_EQ(curves[i]["piece"], i);
    EXPECT_EQ(curves[i]["contour"], i + 1);
    EXPECT_EQ(curves[i]["number"], i + 1);
    EXPECT_EQ(curves[i]["name"], "Curve " + std::to_string(i + 1));
  }
  // The second alone: it comes first in the lists now, and is still Curve 2.
  const double y = curves[1]["sketched"]["deviation_from_points"]["worst_point_px"][1].get<double>();
  const std::string rows = y < 100.0 ? "0,0,320,100" : "0,100,320,100";
  ASSERT_EQ(run("trace " + file("two.pgm") + " --recipe " + file("kept.json") + " --roi " + rows + " -o " +
                file("o.json") + " --report " + file("alone.json"))
                .code,
            0);
  const json alone = json::parse(test::readFile(file("alone.json")))["curves"];
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone[0]["index"], 0);
  EXPECT_EQ(alone[0]["piece"], 0);
  EXPECT_EQ(alone[0]["contour"], 1);
  EXPECT_EQ(alone[0]["number"], 2);
  EXPECT_EQ(alone[0]["name"], "Curve 2");
}

TEST_F(ReportContours, GiveAreasInPxAndMm) {
  ASSERT_EQ(run("trace " + scene() + " --dpi 254 -o " + file("o.json") + " --report " + file("r.json")).code, 0);
  const json contour = json::parse(test::readFile(file("r.json")))["contours"][0];
  EXPECT_EQ(contour["kind"], "outline");
  const auto truth = test::truthShape("ellipse", 480, 320).outline();
  double area = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vec2 &a = truth[i], &b = truth[(i + 1) % truth.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(contour["area_px2"].get<double>(), std::abs(area), 0.002 * std::abs(area));
  EXPECT_NEAR(contour["area_mm2"].get<double>(), 0.01 * std::abs(area), 0.00002 * std::abs(area));
}

}  // namespace
}  // namespace batten
