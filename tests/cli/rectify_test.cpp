// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/support/photo_page.h"

namespace batten {
namespace {

/// A circle and a square on a sheet of A5 that lies on a dark table.
class Rectify : public test::Program {
 protected:
  std::string photo(double tiltDeg) const {
    const test::PhotoCamera camera(poseOf(tiltDeg), 720, 960);
    const auto darkness = [](const Vec2& mm) {
      const bool isRing = std::abs((mm - Vec2(74, 60)).norm() - 35.0) < 0.6;
      const Vec2 off = (mm - Vec2(74, 155)).cwiseAbs();
      const bool isSquare = std::abs(off.maxCoeff() - 30.0) < 0.6;
      return isRing || isSquare ? 1.0 : 0.0;
    };
    write("photo.png", pngOf(renderPhoto(camera, darkness).grey));
    return file("photo.png");
  }
  static test::PhotoPose poseOf(double tiltDeg) {
    return {.widthMm = 148.0, .heightMm = 210.0, .tiltDeg = tiltDeg, .panDeg = 0.6 * tiltDeg, .rollDeg = 4.0};
  }
  nlohmann::json traced(const std::string& words) const {
    const auto done = run("trace " + words);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? nlohmann::json::parse(done.out) : nlohmann::json();
  }
  /// Width over height of the first curve's box, by its control points.
  double aspectOfFirst(const std::string& name) const {
    const auto curves = nlohmann::json::parse(test::readFile(file(name)));
    Vec2 low(1e9, 1e9), high(-1e9, -1e9);
    for (const auto& piece : curves.at("curves").at(0).at("pieces")) {
      for (const auto& p : piece.at("control_points_mm")) {
        low = low.cwiseMin(Vec2(p.at(0).get<double>(), p.at(1).get<double>()));
        high = high.cwiseMax(Vec2(p.at(0).get<double>(), p.at(1).get<double>()));
      }
    }
    return (high - low).x() / (high - low).y();
  }
};

TEST_F(Rectify, TheSheetIsFoundAndTheCircleIsRoundAgain) {
  const std::string scan = photo(25.0);
  const auto before = traced(scan + " --dpi 150 -o " + file("before.json"));
  EXPECT_FALSE(before.contains("rectified"));
  EXPECT_NE(before.at("notes").dump().find("paper.rectify=auto"), std::string::npos) << before.at("notes");
  const auto after = traced(scan + " --set paper.rectify=auto --set paper.format=a5 -o " + file("after.json") +
                            " --save-recipe " + file("used.json") + " --dump thresholds=" + file("t.png"));
  ASSERT_TRUE(after.contains("rectified"));
  EXPECT_NEAR(after["rectified"]["aspect"].get<double>(), 148.0 / 210.0, 1e-3);
  EXPECT_NE(after.at("notes").dump().find("was rectified"), std::string::npos);
  EXPECT_EQ(after.at("notes").dump().find("no resolution"), std::string::npos) << "the format tells the scale";
  EXPECT_EQ(after.at("curves"), 2) << after.at("notes");
  EXPECT_NEAR(aspectOfFirst("after.json"), 1.0, 0.01);
  EXPECT_GT(std::abs(aspectOfFirst("before.json") - 1.0), 0.03);
  // The recipe holds the corners: the same page again, without looking for the sheet.
  const auto recipe = nlohmann::json::parse(test::readFile(file("used.json")));
  EXPECT_NE(recipe.at("parameters").at("paper.rectify"), "auto") << recipe.dump();
  const auto again = traced(scan + " --recipe " + file("used.json") + " -o " + file("again.json"));
  EXPECT_EQ(again["rectified"], after["rectified"]);
  EXPECT_EQ(test::readFile(file("again.json")), test::readFile(file("after.json")));
}

TEST_F(Rectify, SuggestOffersIt) {
  const auto angled = run("suggest " + photo(25.0));
  ASSERT_EQ(angled.code, 0) << angled.err;
  const auto advice = nlohmann::json::parse(angled.out);
  ASSERT_TRUE(advice.at("rectify").is_object()) << angled.out;
  const auto truth = test::PhotoCamera(poseOf(25.0), 720, 960).corners();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(advice["rectify"]["corners"][i][0].get<double>(), truth[i].x(), 0.3);
    EXPECT_NEAR(advice["rectify"]["corners"][i][1].get<double>(), truth[i].y(), 0.3);
  }
  EXPECT_GT(advice["rectify"]["skew"].get<double>(), 1.0);
  EXPECT_GT(advice["rectify"]["convergence"].get<double>(), 1.0);
  const auto upright = run("suggest " + photo(0.0));
  ASSERT_EQ(upright.code, 0) << upright.err;
  EXPECT_TRUE(nlohmann::json::parse(upright.out).at("rectify").is_null());
}

TEST_F(Rectify, WhatCannotBeRectifiedIsTold) {
  const std::string scan = scene();  // a page without a table
  const auto done = traced(scan + " --dpi 300 --set paper.rectify=auto -o " + file("out.json"));
  EXPECT_FALSE(done.contains("rectified"));
  EXPECT_NE(done.at("notes").dump().find("was not rectified"), std::string::npos) << done.at("notes");
  const std::string out = " -o " + file("out.json");
  expectError("trace " + scan + " --set paper.rectify=1,2,3" + out, 2, "paper.rectify cannot be");
  expectError("trace " + scan + " --set paper.rectify=10,10,400,10,10,300,400,300" + out, 2, "must not cross");
  expectError("trace " + scan + " --set paper.rectify=10,10,10,300,400,300,400,10" + out, 2, "clockwise");
  expectError("trace " + scan + " --set paper.rectify=10,10,4000,10,4000,300,10,300" + out, 2, "outside the picture");
  expectError("trace " + scan + " --set paper.rectify=1e300,10,400,10,400,300,10,300" + out, 2, "paper.rectify");
  expectError("suggest " + scan + " --set paper.rectify=10,10,10,300,400,300,400,10", 2, "clockwise");
}

TEST_F(Rectify, TheOverviewOfABatchShowsTheRectifiedPage) {
  photo(25.0);
  const auto done = run("batch " + file("photo.png") + " --to " + file("curves") +
                        " --formats json --set paper.rectify=auto --sheet " + file("sheet.html"));
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string html = test::readFile(file("sheet.html"));
  const auto at = html.find("aspect-ratio:");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(html.substr(at + 13)), 148.0 / 210.0, 0.02) << "not that of the photograph";
}

// A record is a file that anyone may have changed: its page must be one that the picture can make.
TEST_F(Rectify, TheOverviewDoesNotTrustTheSizeInARecord) {
  photo(25.0);
  const std::string call = "batch " + file("photo.png") + " --to " + file("curves") +
                           " --formats json --set paper.rectify=auto --sheet " + file("sheet.html");
  ASSERT_EQ(run(call).code, 0);
  const std::string name = "curves/photo.json.batch.json";
  auto record = nlohmann::ordered_json::parse(test::readFile(file(name)));
  record.at("figures").at("rectified").at("width") = 8000;
  record["figures"]["rectified"].at("height") = 4000;
  write(name, record.dump());
  ASSERT_EQ(run(call).code, 0);
  const std::string html = test::readFile(file("sheet.html"));
  const auto at = html.find("aspect-ratio:");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(html.substr(at + 13)), 720.0 / 960.0, 0.02) << "the picture as it is";
}

}  // namespace
}  // namespace batten
