// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/import_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "core/exchange/export_file.h"
#include "core/exchange/import_lines.h"
#include "core/exchange/occt/open_cascade.h"
#include "core/exchange/point_file.h"
#include "tests/unit/exchange/exchange_shapes.h"
#include "tests/unit/exchange/import_folder.h"

namespace batten {
namespace {

namespace fs = std::filesystem;
using test::damage;
using test::exported;
using test::Import;
using testing::HasSubstr;

std::vector<NurbsCurve> curvesOf(const ImportReport& report) {
  std::vector<NurbsCurve> curves;
  for (const ImportedLine& line : report.file.lines)
    for (const ImportedCurve& curve : line.curves) curves.push_back(curve.curve);
  return curves;
}

/// Largest distance at 200 equal fractions of the parameters, whichever way round.
double apart(const NurbsCurve& a, const NurbsCurve& b) {
  double same = 0.0, turned = 0.0;
  for (int i = 0; i <= 200; ++i) {
    const double f = i / 200.0;
    const Vec2 p = a.point(a.start() + f * (a.end() - a.start()));
    same = std::max(same, (p - b.point(b.start() + f * (b.end() - b.start()))).norm());
    turned = std::max(turned, (p - b.point(b.end() - f * (b.end() - b.start()))).norm());
  }
  return std::min(same, turned);
}

TEST_F(Import, WhatBattenWritesComesBackExactlyInEveryFormatAndUnit) {
  for (const ExportDocument& document : {test::exportOfAllKinds(), test::exportOfAllDegrees()}) {
    std::vector<NurbsCurve> written;
    for (const ExportCurve& line : document.curves) {
      for (const ExportPiece& piece : line.pieces) written.push_back(piece.curve);
    }
    for (const char* ending : {".dxf", ".igs", ".step", ".svg", ".json"}) {
      if (!hasOpenCascade() && (std::string(ending) == ".igs" || std::string(ending) == ".step")) continue;
      for (const LengthUnit unit : {LengthUnit::Millimetre, LengthUnit::Inch}) {
        const fs::path path = folder_ / (std::string("a") + ending);
        ExportSettings settings;
        settings.format = *formatOf(path);
        settings.unit = unit;
        settings.splinesOnly = true;
        const auto report = exportToFile(document, settings, path);
        ASSERT_TRUE(report) << ending << " " << report.error().message;
        const auto back = readImportFile(path);
        ASSERT_TRUE(back) << ending << " " << back.error().message;
        const auto curves = curvesOf(*back);
        ASSERT_EQ(curves.size(), written.size()) << ending;
        for (std::size_t i = 0; i < curves.size(); ++i) EXPECT_LE(apart(curves[i], written[i]), 1e-9) << ending << i;
        EXPECT_TRUE(back->notes.empty()) << ending << back->notes.front();
      }
    }
  }
}

const char* const kDxfHead = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
const char* const kDxfEnd = "0\nENDSEC\n0\nEOF\n";

TEST_F(Import, EntitiesThatMeetBecomeOneLineWithCorners) {
  // A line, a quarter of a circle that goes on from it, whichever way it is written, and a line back: closed.
  const std::string text = std::string(kDxfHead) + "0\nLINE\n8\nA\n10\n0\n20\n0\n11\n10\n21\n0\n" +
                           "0\nARC\n8\nA\n10\n0\n20\n0\n40\n10\n50\n0\n51\n90\n" +
                           "0\nLINE\n8\nA\n10\n0\n20\n10\n11\n0\n21\n0\n" + "0\nCIRCLE\n8\nA\n10\n50\n20\n0\n40\n5\n" +
                           kDxfEnd;
  const ImportReport report = read("a.dxf", text);
  ASSERT_EQ(report.file.lines.size(), 2u);
  EXPECT_EQ(report.file.lines[0].curves.size(), 3u);
  EXPECT_TRUE(report.file.lines[0].closed);
  EXPECT_TRUE(report.file.lines[1].closed) << "the circle";
  EXPECT_EQ(report.file.unit, "mm");
  EXPECT_EQ(report.file.source, "a.dxf");
}

TEST_F(Import, PolylinesBecomePointsWithTheirCorners) {
  std::string text = std::string(kDxfHead) + "0\nLWPOLYLINE\n8\nA\n90\n4\n70\n1\n";
  for (const char* p : {"10\n0\n20\n0\n", "10\n30\n20\n0\n", "10\n30\n20\n20\n", "10\n0\n20\n20\n"}) text += p;
  // A dense arch with one sharp tip.
  text += "0\nLWPOLYLINE\n8\nA\n90\n41\n70\n0\n";
  for (int i = 0; i <= 40; ++i) {
    const double x = i, y = 20.0 - std::abs(i - 20);
    text += "10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n";
  }
  const ImportReport report = read("p.dxf", text + kDxfEnd);
  ASSERT_EQ(report.file.lines.size(), 2u);
  EXPECT_EQ(report.file.lines[0].points.size(), 4u);
  EXPECT_TRUE(report.file.lines[0].closed);
  EXPECT_EQ(report.file.lines[0].corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(report.file.lines[1].points.size(), 41u);
  EXPECT_EQ(report.file.lines[1].corners, (std::vector<int>{20}));
}

/// A line of many measured points, each off by a quarter of their distance: an arch that is sharp in its middle if
/// `isSharp`.
std::vector<Vec2> measuredArch(int count, bool isSharp) {
  std::mt19937 random(5);
  const double step = 0.02;
  std::normal_distribution<double> tremor(0.0, 0.25 * step);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double x = step * (i - count / 2), width = step * count;
    const double y = isSharp ? -std::abs(x) : -x * x / width;
    points.emplace_back(x + tremor(random), y + tremor(random));
  }
  return points;
}

TEST(SharpPoints, ATremorMakesNoCornersAndHidesNone) {
  EXPECT_TRUE(sharpPoints(measuredArch(30'000, false), false).empty());
  const std::vector<int> corners = sharpPoints(measuredArch(30'000, true), false);
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners.front(), 15'000, 4);
}

TEST(SharpPoints, APolygonOfManyCornersHasThemAll) {
  std::vector<Vec2> comb, star;
  for (int i = 0; i < 200; ++i) {
    comb.emplace_back(i, i % 2 == 0 ? 0.0 : 40.0);
    const double radius = i % 2 == 0 ? 50.0 : 20.0, angle = 2.0 * std::numbers::pi * i / 200.0;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  EXPECT_EQ(sharpPoints(comb, false).size(), 198u) << "all but its ends";
  EXPECT_EQ(sharpPoints(star, true).size(), 200u);
  // Round shapes of chords have none, however few.
  for (const int count : {20, 40, 400}) {
    std::vector<Vec2> ring;
    for (int i = 0; i < count; ++i)
      ring.emplace_back(std::cos(2.0 * std::numbers::pi * i / count), std::sin(2.0 * std::numbers::pi * i / count));
    EXPECT_TRUE(sharpPoints(ring, true).empty()) << count;
  }
}

TEST_F(Import, APolygonOfManyPointsHasExactSides) {
  std::string comb = "x_mm,y_mm\n", few = comb;
  for (int i = 0; i < 40; ++i) comb += std::to_string(i) + (i % 2 == 0 ? ",0\n" : ",40\n");
  for (int i = 0; i < 10; ++i) few += std::to_string(i) + (i % 2 == 0 ? ",0\n" : ",40\n");
  const ImportReport report = read("comb.csv", comb);
  ASSERT_EQ(report.file.lines.size(), 1u);
  const ImportedLine& line = report.file.lines.front();
  EXPECT_TRUE(line.points.empty());
  ASSERT_EQ(line.curves.size(), 39u);
  for (const ImportedCurve& side : line.curves) EXPECT_EQ(side.curve.degree(), 1);
  EXPECT_EQ(line.curves[3].curve.point(line.curves[3].curve.start()), Vec2(3.0, 40.0));
  EXPECT_EQ(read("few.csv", few).file.lines.front().points.size(), 10u) << "drawn corner by corner";
}

TEST_F(Import, AScatterOfPointsIsRefusedAboveALimitThatIsNamed) {
  std::string text = "x_mm,y_mm\n";
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 200.0);
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200mm\" height=\"200mm\"><path d=\"M0 0";
  for (int i = 0; i < 60'000; ++i) {
    const std::string x = std::to_string(place(random)), y = std::to_string(place(random));
    text += x + "," + y + "\n";
    svg += " L" + x + " " + y;
  }
  EXPECT_THAT(refusal("scatter.csv", text), HasSubstr("50000 places at most"));
  EXPECT_THAT(refusal("scatter.svg", svg + "\"/></svg>"), HasSubstr("50000 places at most"));
}

TEST_F(Import, TheUnitIsThatOfTheFileElseMillimetresElseWhatTheUserSays) {
  const std::string line = "0\nLINE\n8\nA\n10\n0\n20\n0\n11\n1\n21\n0\n";
  const std::string bare = "0\nSECTION\n2\nENTITIES\n" + line + kDxfEnd;
  const ImportReport assumed = read("bare.dxf", bare);
  EXPECT_EQ(assumed.file.unit, "mm?");
  ASSERT_EQ(assumed.notes.size(), 1u);
  EXPECT_THAT(assumed.notes[0], HasSubstr("no unit"));
  const ImportReport told = read("bare.dxf", bare, 25.4);
  EXPECT_EQ(told.file.unit, "in");
  EXPECT_NEAR(curvesOf(told)[0].controlPoints()[1].x(), 25.4, 1e-12);
}

TEST_F(Import, TheUsersUnitGoesBeforeThatOfSvgAndOwnFiles) {
  const std::string sized =
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 200 100">)"
      R"(<path d="M0,100 L40,100"/></svg>)";
  EXPECT_NEAR(curvesOf(read("a.svg", sized))[0].controlPoints().back().x(), 20.0, 1e-12);
  const ImportReport inches = read("a.svg", sized, 25.4);
  EXPECT_EQ(inches.file.unit, "in");
  EXPECT_NEAR(curvesOf(inches)[0].controlPoints().back().x(), 1016.0, 1e-9);
  const ImportReport bare = read("b.svg", R"(<svg xmlns="http://www.w3.org/2000/svg"><line x2="3"/></svg>)", 10.0);
  EXPECT_TRUE(bare.notes.empty()) << "nothing was assumed";
  EXPECT_NEAR(curvesOf(bare)[0].controlPoints().back().x(), 30.0, 1e-9);
  for (const char* ending : {".svg", ".json"}) {
    ExportSettings settings;
    const fs::path path = folder_ / (std::string("own") + ending);
    settings.format = *formatOf(path);
    ASSERT_TRUE(exportToFile(test::exportOfAllKinds(), settings, path));
    const auto plain = readImportFile(path), scaled = readImportFile(path, 10.0);
    ASSERT_TRUE(plain && scaled);
    EXPECT_EQ(scaled->file.unit, "cm");
    EXPECT_LE((10.0 * curvesOf(*plain)[0].controlPoints()[1] - curvesOf(*scaled)[0].controlPoints()[1]).norm(), 1e-9);
  }
}

TEST_F(Import, NamesAndLayersComeBackFromOwnFiles) {
  ExportDocument document = test::exportOfAllKinds();
  std::vector<std::string> names, layers;
  for (ExportCurve& line : document.curves) {
    line.layer = layers.size() % 2 == 0 ? "Body side" : "Glass";
    layers.push_back(line.layer);
    for (ExportPiece& piece : line.pieces) {
      piece.name = "Character line " + std::to_string(names.size() + 1);
      names.push_back(piece.name);
    }
  }
  for (const std::string ending : {".dxf", ".igs", ".step", ".svg", ".json"}) {
    if (!hasOpenCascade() && (ending == ".igs" || ending == ".step")) continue;
    const fs::path path = folder_ / ("named" + ending);
    ExportSettings settings;
    settings.format = *formatOf(path);
    ASSERT_TRUE(exportToFile(document, settings, path)) << ending;
    const auto back = readImportFile(path);
    ASSERT_TRUE(back) << ending << back.error().message;
    // STEP holds its curves layer by layer.
    std::multiset<std::string> namesBack, layersBack;
    std::map<std::string, std::string> layerOf;
    for (const ImportedLine& line : back->file.lines) {
      layersBack.insert(line.layer);
      for (const ImportedCurve& curve : line.curves) {
        namesBack.insert(curve.name);
        layerOf[curve.name] = line.layer;
      }
    }
    EXPECT_EQ(namesBack, std::multiset<std::string>(names.begin(), names.end())) << ending;
    if (ending == ".igs") continue;  // levels have numbers
    EXPECT_EQ(layersBack, std::multiset<std::string>(layers.begin(), layers.end())) << ending;
    EXPECT_EQ(layerOf[names[0]], "Body side") << ending;
    EXPECT_EQ(layerOf[names[1]], "Glass") << ending;
  }
}

TEST_F(Import, NamesOfOtherBytesAreShownAndTextsOfOthersAreNone) {
  const std::string line = "10\n0\n20\n0\n11\n10\n21\n0\n";
  const ImportReport report =
      read("a.dxf", std::string(kDxfHead) + "0\nLINE\n8\nDach \xe4\n" + line + "1001\nACME\n1000\nsecret\n" +
                        "0\nLINE\n8\n0\n10\n0\n20\n9\n11\n10\n21\n9\n1001\nBATTEN\n1000\nroof\x01line\n" + kDxfEnd);
  ASSERT_EQ(report.file.lines.size(), 2u);
  EXPECT_EQ(report.file.lines[0].name, "");
  EXPECT_EQ(report.file.lines[0].layer, "Dach \xEF\xBF\xBD");
  EXPECT_EQ(report.file.lines[1].name, "roof?line");
  EXPECT_EQ(report.file.lines[1].layer, "") << "layer 0 is none";
}

TEST_F(Import, AnAssignedLayerOfAStepCounts) {
  if (!hasOpenCascade()) GTEST_SKIP() << "built without Open CASCADE";
  ExportDocument document = test::exportOfAllKinds();
  document.curves.resize(1);
  document.curves[0].pieces[0].name = "sill";
  ExportSettings settings;
  settings.format = ExportFormat::Step;
  std::string step = exportedFile(document, settings)->bytes;
  const auto name = step.find("B_SPLINE_CURVE_WITH_KNOTS('sill'");
  ASSERT_NE(name, std::string::npos);
  const auto hash = step.rfind('#', name);
  const std::string id = step.substr(hash, step.find_first_of(" =", hash) - hash);
  step.insert(step.rfind("ENDSEC;"), "#99999=PRESENTATION_LAYER_ASSIGNMENT('Glass','',(" + id + "));\n");
  const ImportReport report = read("layer.step", step);
  EXPECT_EQ(report.file.lines.at(0).layer, "Glass");
  EXPECT_EQ(report.file.lines[0].curves.at(0).name, "sill");
}

TEST_F(Import, TheUnitsOfADxfAreKnown) {
  const auto length = [&](const char* unit) {
    const ImportReport report =
        read("u.dxf", std::string("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n") + unit +
                          "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n0.01\n21\n0\n"
                          "0\nENDSEC\n0\nEOF\n");
    EXPECT_TRUE(report.notes.empty()) << unit;
    const NurbsCurve& line = report.file.lines.at(0).curves.at(0).curve;
    return line.point(line.end()).x();
  };
  EXPECT_NEAR(length("3"), 16093.44, 1e-9);
  EXPECT_NEAR(length("7"), 10000.0, 1e-9);
  EXPECT_NEAR(length("10"), 9.144, 1e-12);
  EXPECT_NEAR(length("2"), 3.048, 1e-12);
}

TEST_F(Import, APolylineWithBulgesBecomesLinesAndArcs) {
  // 10 mm to the right, half a circle to the left over (15, 5), 10 mm back, closed by a chord.
  const std::string dxf =
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n42\n1\n"
      "10\n10\n20\n10\n10\n0\n20\n10\n0\nENDSEC\n0\nEOF\n";
  const ImportReport report = read("slot.dxf", dxf, 1.0);
  ASSERT_EQ(report.file.lines.size(), 1u);
  const ImportedLine& line = report.file.lines[0];
  EXPECT_TRUE(line.closed);
  ASSERT_EQ(line.curves.size(), 4u);
  EXPECT_EQ(line.curves[0].curve.degree(), 1);
  EXPECT_EQ(line.curves[2].curve.degree(), 1);
  const NurbsCurve& arc = line.curves[1].curve;
  EXPECT_LT((arc.point(0.5 * (arc.start() + arc.end())) - Vec2(15, 5)).norm(), 1e-12);
  EXPECT_LT((arc.point(arc.start()) - Vec2(10, 0)).norm(), 1e-12);
}

TEST_F(Import, ReadsTablesOfPointsAsPeopleWriteThem) {
  struct Case {
    const char* text;
    double x, y;  // of the second point, mm
    std::size_t lines, points;
  };
  for (const Case& c :
       {Case{"0,0\n1.5,2\n3,1\n", 1.5, 2.0, 1, 3}, Case{"x_in,y_in\r\n0,0\r\n1,2\r\n", 25.4, 50.8, 1, 2},
        Case{"# a comment\nx;y\n0;0\n1,5;2,25\n", 1.5, 2.25, 1, 2},
        Case{"0\t0\n1\t2\n\n5\t5\n6\t6\n7\t5\n", 1.0, 2.0, 2, 2}, Case{"  0   0\n  1   2 9 9\n", 1.0, 2.0, 1, 2},
        Case{"curve,s_mm,x_mm,y_mm\nA,0,0,0\nA,1,3,4\nB,0,9,9\nB,1,8,8\n", 3.0, 4.0, 2, 2},
        Case{"1,5 2\n2,25 3,5\n", 2.25, 3.5, 1, 2}, Case{"x y\n0 0\n1,5 2,5\n", 1.5, 2.5, 1, 2},
        Case{"0, 0\n1, 2\n", 1.0, 2.0, 1, 2}, Case{"\xef\xbb\xbfx [cm],y [cm]\n0,0\n1,2\n", 10.0, 20.0, 1, 2}}) {
    const ImportReport report = read("p.csv", c.text);
    ASSERT_EQ(report.file.lines.size(), c.lines) << c.text;
    ASSERT_EQ(report.file.lines[0].points.size(), c.points) << c.text;
    EXPECT_NEAR((report.file.lines[0].points[1] - Vec2(c.x, c.y)).norm(), 0.0, 1e-12) << c.text;
  }
  EXPECT_TRUE(read("loop.csv", "0,0\n1,0\n1,1\n0,0\n").file.lines[0].closed);
  EXPECT_THAT(refusal("bad.csv", "0,0\n1,1\nx,2\n"), HasSubstr("row 3"));
  EXPECT_THAT(refusal("nan.csv", "0,0\nnan,1\n"), HasSubstr("row 2"));
  EXPECT_THAT(refusal("own.poly.csv", "curve,piece,span,u_start,u_end,x0,x1,y0,y1\na,b,1,0,1,0,1,0,1\n"),
              HasSubstr("coefficients"));
  EXPECT_THAT(refusal("one.csv", "0,0\n"), HasSubstr("no line"));
  EXPECT_THAT(refusal("empty.csv", ""), HasSubstr("the file is empty"));
  EXPECT_THAT(refusal("far.csv", "0,0\n1e9,1\n"), HasSubstr("unit"));
}

TEST_F(Import, ReadsPointsOfJson) {
  EXPECT_EQ(read("a.json", "[[0,0],[1,2],[3,1]]").file.lines[0].points.size(), 3u);
  EXPECT_EQ(read("b.json", "[[[0,0],[1,2]],[[3,1],[4,4]]]").file.lines.size(), 2u);
  const ImportReport named =
      read("c.json", R"({"unit":"in","lines":[{"name":"Dach 漢","closed":true,"points":[[0,0],[1,0],[1,1],[0,0]]}]})");
  ASSERT_EQ(named.file.lines.size(), 1u);
  EXPECT_EQ(named.file.lines[0].name, "Dach 漢");
  EXPECT_EQ(named.file.lines[0].points.size(), 3u);
  EXPECT_NEAR(named.file.lines[0].points[1].x(), 25.4, 1e-12);
  for (const char* text : {"", "{", "[1,2]", "{\"lines\":3}", "[[0,0],[1]]", "[[0,0],\"x\"]",
                           "{\"unit\":\"ell\",\"lines\":[]}", "[]", "null", "[[0,0],[1e999,0]]"}) {
    EXPECT_NE(refusal("d.json", text), "read") << text;
  }
  EXPECT_NE(refusal("deep.json", std::string(100000, '[')), "read");
}

TEST_F(Import, DamagedFilesOfEveryKindAreRefusedOrRead) {
  for (const char* ending : {".dxf", ".svg", ".json", ".csv"}) {
    damage(
        exported(ending),
        [&](const std::string& text) { return readImportFile(write(std::string("d") + ending, text)); }, 701);
  }
  const std::string shapes =
      "<svg width='100mm' height='50mm' viewBox='0 0 200 100'><g transform='rotate(10)'><path d='M0 0C1 2 3 2 4 0S7-2 "
      "8 0z'/>"
      "<rect width='5' height='5' rx='1'/><polygon points='1,1 2,2 3,1'/></g></svg>";
  damage(
      shapes, [&](const std::string& text) { return readImportFile(write("s.svg", text)); }, 1);
  std::string deep = "<svg>";
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  EXPECT_THAT(refusal("deep.svg", deep), HasSubstr("256"));
  EXPECT_THAT(refusal("entities.svg",
                      "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>"
                      "<!ENTITY c '&b;&b;&b;&b;&b;&b;&b;&b;&b;&b;'><!ENTITY d '&c;&c;&c;&c;&c;&c;&c;&c;&c;&c;'>"
                      "<!ENTITY e '&d;&d;&d;&d;&d;&d;&d;&d;&d;&d;'>]><svg><title>&e;&e;&e;</title></svg>"),
              testing::Not(HasSubstr("read\n")));
  EXPECT_THAT(refusal("empty.svg", "<svg/>"), HasSubstr("no line"));
  EXPECT_THAT(refusal("a.xyz", "x"), HasSubstr(".dxf"));
  EXPECT_THAT(readImportFile(folder_ / "none.dxf").error().message, HasSubstr("does not exist"));
  CancelToken token;
  token.cancel();
  RunContext context;
  context.cancel = token;
  std::string many;
  for (int i = 0; i < 10000; ++i) many += "1,2\n2,1\n";
  EXPECT_EQ(readImportFile(write("many.csv", many), {}, context).error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace batten
