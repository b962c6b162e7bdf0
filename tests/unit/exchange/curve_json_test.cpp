// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/exchange/text/curve_json.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

using test::exportOfAllKinds;

TEST(CurveJson, ReadsBackEveryCurveExactly) {
  ExportDocument document = exportOfAllKinds();
  document.curves.front().strokeWidthMm = 0.7;
  document.curves.front().pieces.front().width = WidthProfile{{{0.0, 0.5}, {1.0 / 3.0, 0.9}, {7.0, 0.0}}, 0.01};
  const auto text = writeCurveJson(document);
  ASSERT_TRUE(text) << text.error().message;
  const auto read = readCurveJson(*text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frame, document.frame);
  EXPECT_EQ(read->dpi, document.dpi);
  EXPECT_EQ(read->imageSha256, document.imageSha256);
  ASSERT_EQ(read->curves.size(), document.curves.size());
  for (std::size_t i = 0; i < read->curves.size(); ++i) {
    EXPECT_EQ(read->curves[i].id, document.curves[i].id);
    EXPECT_EQ(read->curves[i].closed, document.curves[i].closed);
    EXPECT_EQ(read->curves[i].strokeWidthMm, document.curves[i].strokeWidthMm);
    ASSERT_EQ(read->curves[i].pieces.size(), document.curves[i].pieces.size());
    for (std::size_t k = 0; k < read->curves[i].pieces.size(); ++k) {
      EXPECT_EQ(read->curves[i].pieces[k].width, document.curves[i].pieces[k].width);
      const NurbsCurve &a = read->curves[i].pieces[k].curve, &b = document.curves[i].pieces[k].curve;
      for (int s = 0; s <= 200; ++s) {
        const double u = b.start() + (b.end() - b.start()) * s / 200.0;
        const auto da = a.derivatives(u, 2), db = b.derivatives(u, 2);
        for (std::size_t d = 0; d <= 2; ++d) EXPECT_LT((da[d] - db[d]).norm(), 1e-12);
      }
    }
  }
}

TEST(CurveJson, RefusesWidthsThatAreNone) {
  ExportDocument document = exportOfAllKinds();
  document.curves.front().pieces.front().width = WidthProfile{{{0.0, 0.5}, {7.0, 0.25}}, 0.01};
  const auto json = nlohmann::json::parse(*writeCurveJson(document));
  EXPECT_EQ(json["curves"][0]["pieces"][0]["width_mm"]["samples"], nlohmann::json::parse("[[0, 0.5], [7, 0.25]]"));
  EXPECT_EQ(json["curves"][0]["pieces"][0]["width_mm"]["tolerance"], 0.01);
  for (const char* samples : {"[]", "[[0, 1]]", "[[0, 1], [0, 2]]", "[[0, 1], [2, -1]]", "[[0, 1], [2]]", "3"}) {
    auto wrong = json;
    wrong["curves"][0]["pieces"][0]["width_mm"]["samples"] = nlohmann::json::parse(samples);
    EXPECT_FALSE(readCurveJson(wrong.dump())) << samples;
  }
  auto without = json;
  without["curves"][0]["pieces"][0].erase("width_mm");
  EXPECT_TRUE(readCurveJson(without.dump()));
  document.curves.front().pieces.front().width->samples.pop_back();
  EXPECT_FALSE(writeCurveJson(document));
}

TEST(CurveJson, HoldsTheContract) {
  const auto json = nlohmann::json::parse(*writeCurveJson(exportOfAllKinds()));
  EXPECT_EQ(json["format"], "batten-curves");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["image"]["width"], 1200);
  EXPECT_EQ(json["image"]["height"], 1000);
  EXPECT_EQ(json["image"]["dpi"], 254.0);
  EXPECT_EQ(json["image"]["sha256"], std::string(64, 'a'));
  EXPECT_EQ(json["mm_per_px"], 0.1);
  for (const auto& curve : json["curves"]) {
    for (const auto& piece : curve["pieces"]) {
      const int degree = piece["degree"];
      const auto knots = piece["knots"].get<std::vector<double>>();
      const auto n = static_cast<int>(piece["control_points_mm"].size());
      ASSERT_EQ(static_cast<int>(knots.size()), n + degree + 1);
      ASSERT_EQ(piece["control_points_px"].size(), piece["control_points_mm"].size());
      EXPECT_EQ(knots.front(), knots[degree]);  // clamped
      for (int i = 0; i < n; ++i) {             // px: y down from the upper edge; mm: y up from the lower one
        const double x = piece["control_points_px"][i][0], y = piece["control_points_px"][i][1];
        EXPECT_NEAR(x * 0.1, piece["control_points_mm"][i][0].get<double>(), 1e-12);
        EXPECT_NEAR(100.0 - y * 0.1, piece["control_points_mm"][i][1].get<double>(), 1e-12);
      }
    }
  }
}

TEST(CurveJson, SaysHowSmoothlyALoopCloses) {
  const auto json = nlohmann::json::parse(*writeCurveJson(exportOfAllKinds()));
  const auto& curves = json["curves"];
  EXPECT_FALSE(curves[0].contains("continuity")) << "an open curve has no seam";
  EXPECT_EQ(curves[3]["continuity"], 3) << "a periodic quintic";
  EXPECT_EQ(curves[5]["continuity"], 0) << "corners";
  // Directions agree at its start, curvatures do not.
  ExportDocument document = exportOfAllKinds();
  document.curves.resize(1);
  document.curves[0].closed = true;
  document.curves[0].pieces[0].curve =
      test::made(2, {0, 0, 0, 1, 2, 3, 4, 4, 4}, {{10, 0}, {20, 0}, {20, 10}, {0, 20}, {0, 0}, {10, 0}});
  EXPECT_EQ(nlohmann::json::parse(*writeCurveJson(document))["curves"][0]["continuity"], 1);
}

TEST(CurveJson, RefusesNumbersThatDoNotFit) {
  for (const char* number : {"4294967297", "18446744073709551617", "-4294967295", "1.5"}) {
    for (const char* what : {"\"version\": 1", "\"width\": 1200", "\"degree\": 5"}) {
      std::string text = *writeCurveJson(exportOfAllKinds());
      const auto at = text.find(what);
      ASSERT_NE(at, std::string::npos) << what;
      const auto digits = text.find(": ", at) + 2;
      text.replace(digits, text.find_first_not_of("0123456789", digits) - digits, number);
      EXPECT_FALSE(readCurveJson(text)) << what << " " << number;
    }
  }
}

TEST(CurveJson, AnAssumedScaleHasNoResolution) {
  ExportDocument document = exportOfAllKinds();
  document.dpi.reset();
  const auto text = writeCurveJson(document);
  EXPECT_TRUE(nlohmann::json::parse(*text)["image"]["dpi"].is_null());
  EXPECT_EQ(readCurveJson(*text)->dpi, std::nullopt);
}

TEST(CurveJson, RefusesNothingAndDamage) {
  ExportDocument document = exportOfAllKinds();
  const std::string text = *writeCurveJson(document);
  for (std::size_t length = 0; length + 2 < text.size(); length += 501) {
    EXPECT_FALSE(readCurveJson(text.substr(0, length))) << length;
  }
  EXPECT_FALSE(readCurveJson("{}"));
  EXPECT_FALSE(readCurveJson("[]"));
  auto json = nlohmann::json::parse(text);
  json["version"] = 2;
  EXPECT_FALSE(readCurveJson(json.dump()));
  json["version"] = 1;
  json["curves"][0]["pieces"][0]["knots"][2] = 99.0;
  EXPECT_FALSE(readCurveJson(json.dump()));
  document.frame.mmPerPx = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(writeCurveJson(document));
  document = exportOfAllKinds();
  document.curves.clear();
  EXPECT_EQ(writeCurveJson(document).error().code, ErrorCode::NoCurve);
}

TEST(CurveJson, SaysHowTheCurvesCameAbout) {
  ExportDocument document = test::exportOfAllKinds();
  document.settings = {{"fairing.mode", "target"}, {"fairing.target", "3"}};
  document.curves[0].name = "Dach";
  document.curves[0].pieces[0].figures = PieceFigures{"target", 3, 0.5, 0.25, 0.125, 0.0625};
  const auto json = nlohmann::json::parse(writeCurveJson(document).value());
  EXPECT_EQ(json["unit"], "mm");
  EXPECT_EQ(json["settings"]["fairing.target"], "3");
  EXPECT_EQ(json["curves"][0]["name"], "Dach");
  const auto& piece = json["curves"][0]["pieces"][0];
  EXPECT_EQ(piece["fairing"]["mode"], "target");
  EXPECT_EQ(piece["fairing"]["target"], 3);
  EXPECT_EQ(piece["fairing"]["tolerance_mm"], 0.5);
  EXPECT_EQ(piece["fairing"]["moved_mm"], 0.25);
  EXPECT_EQ(piece["deviation_mm"]["max"], 0.125);
  EXPECT_EQ(piece["deviation_mm"]["rms"], 0.0625);
  EXPECT_FALSE(json["curves"][0].contains("corners_mm"));
  ASSERT_EQ(json["curves"][5]["corners_mm"].size(), 3u) << "of the loop";
  EXPECT_EQ(json["curves"][5]["corners_mm"][1][0], 110.0);
  EXPECT_EQ(readCurveJson(json.dump())->curves[0].name, "Dach");
}

}  // namespace
}  // namespace batten
